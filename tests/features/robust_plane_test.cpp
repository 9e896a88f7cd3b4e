// Planes through neighbourhoods, against Eigen and against what outliers must not do.

#include "features/segment/robust_plane.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "features/numerics/exact_math.h"

namespace arris {
namespace {

using Points = std::vector<Eigen::Vector3d>;

void put(NeighbourhoodBatch& batch, std::size_t lane, const Points& points) {
  batch.neighbours = points.size();
  batch.lanes = kBatchLanes;
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    batch.x[i][lane] = points[i].x();
    batch.y[i][lane] = points[i].y();
    batch.z[i][lane] = points[i].z();
    sum += points[i].norm();
  }
  batch.mean_distance[lane] = sum / static_cast<double>(points.size());
}

Eigen::Vector3d normal_of(const PlaneBatch& planes, std::size_t lane) {
  return {planes.nx[lane], planes.ny[lane], planes.nz[lane]};
}

/// Points in a disc of radius `radius` at right angles to `normal`, about the origin, with noise along it.
Points disc(std::size_t count, const Eigen::Vector3d& normal, double radius, double noise, std::mt19937_64& random) {
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::normal_distribution<double> gauss(0.0, noise);
  Points points;
  while (points.size() < count) {
    const double a = uniform(random), b = uniform(random);
    if (a * a + b * b > 1.0) continue;
    points.push_back(radius * (a * u + b * v) + (noise > 0.0 ? gauss(random) : 0.0) * normal);
  }
  return points;
}

RC_GTEST_PROP(ExponentialDecay, IsThatOfTheLibraryToFourteenDigits, ()) {
  const double x = *rc::gen::inRange(0, 650000) / 1000.0;
  RC_ASSERT(std::fabs(exponential_decay(x) - std::exp(-x)) <= 1e-14 * std::exp(-x));
}

TEST(ExponentialDecay, Ends) {
  EXPECT_EQ(exponential_decay(0.0), 1.0);
  EXPECT_EQ(exponential_decay(1e300), 0.0);
}

TEST(MedianPlan, EightNeighboursOrFewer_EveryTripleIsTried) {
  EXPECT_EQ(MedianPlan(3).triples.size(), 1U);
  EXPECT_EQ(MedianPlan(8).triples.size(), 56U);
  for (const std::size_t n : {9U, 30U, 64U}) {
    const MedianPlan plan(n);
    EXPECT_EQ(plan.triples.size(), MedianPlan::kMostTriples);
    std::set<std::array<std::uint8_t, 3>> different(plan.triples.begin(), plan.triples.end());
    EXPECT_EQ(different.size(), plan.triples.size());
    for (const auto& [a, b, c] : plan.triples) EXPECT_TRUE(a < b && b < c && c < n);
  }
}

RC_GTEST_PROP(PlainPlane, IsThatOfEigen, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  NeighbourhoodBatch batch;
  std::vector<Points> clouds;
  const auto n = static_cast<std::size_t>(*rc::gen::inRange(3, 20));
  std::normal_distribution<double> gauss(0.0, 100.0);
  for (std::size_t lane = 0; lane < kBatchLanes; ++lane) {
    Points points(n);
    for (auto& p : points) p = {gauss(random), gauss(random), 0.3 * gauss(random)};
    put(batch, lane, points);
    clouds.push_back(points);
  }
  PlaneBatch planes;
  fit_plain_planes(batch, planes);
  for (std::size_t lane = 0; lane < kBatchLanes; ++lane) {
    Points all = clouds[lane];
    all.emplace_back(0.0, 0.0, 0.0);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const auto& p : all) mean += p / static_cast<double>(all.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const auto& p : all) covariance += (p - mean) * (p - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    const auto values = solver.eigenvalues();
    RC_ASSERT(std::fabs(planes.variation[lane] - values[0] / values.sum()) < 1e-9);
    RC_ASSERT(std::fabs(planes.width[lane] - values[1] / values[2]) < 1e-9);
    if (values[1] - values[0] > 1e-3 * values[2])
      RC_ASSERT(std::fabs(normal_of(planes, lane).dot(solver.eigenvectors().col(0))) > 1.0 - 1e-9);
  }
}

// Three of eight neighbours are on another surface.
TEST(RobustPlane, OutliersBelowHalf_TurnItLittle) {
  std::mt19937_64 random(5);
  double robust_deg = 0.0, plain_deg = 0.0;
  constexpr int kTrials = 40;
  for (int trial = 0; trial < kTrials; ++trial) {
    NeighbourhoodBatch batch;
    const Eigen::Vector3d normal = Eigen::Vector3d::Random().normalized();
    for (std::size_t lane = 0; lane < kBatchLanes; ++lane) {
      Points points = disc(5, normal, 400.0, 0.0, random);
      for (const auto& p : disc(3, normal, 400.0, 0.0, random)) points.push_back(p + 900.0 * normal);
      std::shuffle(points.begin(), points.end(), random);
      put(batch, lane, points);
    }
    PlaneBatch plain, robust;
    fit_plain_planes(batch, plain);
    fit_robust_planes(batch, MedianPlan(8), {}, robust);
    for (std::size_t lane = 0; lane < kBatchLanes; ++lane) {
      const auto angle_deg = [&](const PlaneBatch& planes) {
        return std::acos(std::min(1.0, std::fabs(normal_of(planes, lane).dot(normal)))) * kDegreesPerRadian;
      };
      robust_deg += angle_deg(robust) / (kTrials * kBatchLanes);
      plain_deg += angle_deg(plain) / (kTrials * kBatchLanes);
    }
  }
  EXPECT_LT(robust_deg, 3.0);
  EXPECT_GT(plain_deg, 40.0);
}

TEST(RobustPlane, NoOutliers_IsThePlainPlane) {
  std::mt19937_64 random(6);
  NeighbourhoodBatch batch;
  for (std::size_t lane = 0; lane < kBatchLanes; ++lane)
    put(batch, lane, disc(12, Eigen::Vector3d::Random().normalized(), 500.0, 5.0, random));
  PlaneBatch plain, robust;
  fit_plain_planes(batch, plain);
  fit_robust_planes(batch, MedianPlan(12), {1000.0, false}, robust);  // Everything is an inlier.
  for (std::size_t lane = 0; lane < kBatchLanes; ++lane) {
    EXPECT_GT(std::fabs(normal_of(robust, lane).dot(normal_of(plain, lane))), 1.0 - 1e-12);
    EXPECT_NEAR(robust.variation[lane], plain.variation[lane], 1e-12);
  }
}

TEST(RobustPlane, PointsOnALine_WidthIsZeroAndNothingIsNan) {
  NeighbourhoodBatch batch;
  for (std::size_t lane = 0; lane < kBatchLanes; ++lane) {
    Points points;
    for (int i = 1; i <= 8; ++i) points.emplace_back(10.0 * i, 20.0 * i, -5.0 * i);
    put(batch, lane, points);
  }
  PlaneBatch plain, robust;
  fit_plain_planes(batch, plain);
  fit_robust_planes(batch, MedianPlan(8), {}, robust);
  for (const PlaneBatch* planes : {&plain, &robust}) {
    for (std::size_t lane = 0; lane < kBatchLanes; ++lane) {
      EXPECT_LT(planes->width[lane], 1e-12);
      EXPECT_TRUE(std::isfinite(planes->nx[lane]) && std::isfinite(planes->variation[lane]));
    }
  }
}

// What is in the other lanes must not matter: the batches are filled as threads come by.
RC_GTEST_PROP(RobustPlane, BitsDoNotDependOnTheLane, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const auto n = static_cast<std::size_t>(*rc::gen::inRange(3, 33));
  NeighbourhoodBatch batch;
  Points points(n);
  std::normal_distribution<double> gauss(0.0, 300.0);
  for (auto& p : points) p = {gauss(random), gauss(random), gauss(random)};
  for (std::size_t lane = 0; lane < kBatchLanes; ++lane) {
    Points others(n);
    for (auto& p : others) p = {gauss(random), gauss(random), gauss(random)};
    put(batch, lane, lane % 3 == 0 ? points : others);
  }
  PlaneBatch planes;
  fit_robust_planes(batch, MedianPlan(n), {}, planes);
  for (std::size_t lane = 3; lane < kBatchLanes; lane += 3) {
    RC_ASSERT(planes.nx[lane] == planes.nx[0]);
    RC_ASSERT(planes.ny[lane] == planes.ny[0]);
    RC_ASSERT(planes.nz[lane] == planes.nz[0]);
    RC_ASSERT(planes.variation[lane] == planes.variation[0]);
  }
}

// A digest of bits: the runs at 16 and 32 bytes must meet the same one.
TEST(RobustPlane, BitsAreTheSameAtEveryVectorWidth) {
  std::mt19937_64 random(7);
  std::uint64_t digest = 0;
  for (const std::size_t n : {3U, 8U, 9U, 30U}) {
    NeighbourhoodBatch batch;
    for (std::size_t lane = 0; lane < kBatchLanes; ++lane) {
      Points points(n);
      for (auto& p : points)
        for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<double>(random() % 2001) - 1000.0;
      put(batch, lane, points);
    }
    PlaneBatch planes;
    fit_robust_planes(batch, MedianPlan(n), {}, planes);
    for (std::size_t lane = 0; lane < kBatchLanes; ++lane) {
      for (const double v : {planes.nx[lane], planes.ny[lane], planes.nz[lane], planes.variation[lane]})
        digest = digest * 0x9e3779b97f4a7c15U + std::bit_cast<std::uint64_t>(v);
    }
  }
  EXPECT_EQ(digest, 5144572597210948506U);
}

}  // namespace
}  // namespace arris
