#include "merge/supervoxel_moments.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>
#include <set>

namespace arris::merge {
namespace {

constexpr double kPi = 3.14159265358979323846;
using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

struct Truth {
  Eigen::Vector3d mean;
  Eigen::Vector3d values;  ///< Ascending.
  Eigen::Vector3d normal;
};

Truth truth_of(const std::vector<LatticePoint>& points) {
  Eigen::MatrixXd p(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    p.col(static_cast<Eigen::Index>(i)) = Eigen::Vector3d(points[i].x, points[i].y, points[i].z);
  const Eigen::Vector3d mean = p.rowwise().mean();
  const Eigen::MatrixXd off = p.colwise() - mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(off * off.transpose() /
                                                              static_cast<double>(points.size()));
  return {mean, solver.eigenvalues(), solver.eigenvectors().col(0)};
}

/// A slab with random axes around a random place.
std::vector<LatticePoint> any_slab(std::mt19937_64& random, std::size_t count, double extent) {
  std::normal_distribution<double> normal;
  Eigen::Matrix3d axes;
  for (Eigen::Index i = 0; i < 9; ++i) axes(i / 3, i % 3) = normal(random);
  axes = Eigen::HouseholderQR<Eigen::Matrix3d>(axes).householderQ();
  const auto place = [&] { return static_cast<double>(static_cast<std::int32_t>(random()) / 2); };
  const Eigen::Vector3d centre(place(), place(), place());
  std::uniform_real_distribution<double> unit(-0.5, 0.5);
  std::vector<LatticePoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d p =
        centre + axes * Eigen::Vector3d(unit(random), 0.6 * unit(random), 0.1 * unit(random)) * extent;
    points.push_back({static_cast<std::int32_t>(std::lround(p[0])), static_cast<std::int32_t>(std::lround(p[1])),
                      static_cast<std::int32_t>(std::lround(p[2]))});
  }
  return points;
}

RC_GTEST_PROP(SupervoxelMoments, AnyPoints_AreThoseOfEigen, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>().as("seed"));
  const double extent = *rc::gen::element(100.0, 3000.0, 100'000.0, 20'000'000.0).as("extent");
  constexpr std::uint32_t kCount = 5;
  SupervoxelMoments moments(kCount, static_cast<std::int64_t>(1.5 * extent));
  // Offsets are rounded to multiples of this; below 2^17 steps not at all.
  const double unit = std::max(1.0, std::exp2(std::ceil(std::log2(1.5 * extent + 1.0)) - 17.0));
  const double slack = unit > 1.0 ? unit : 1e-6;
  std::vector<std::vector<LatticePoint>> members(kCount + 1);
  for (std::uint32_t id = 1; id <= kCount; ++id) members[id] = any_slab(random, 20 + random() % 400, extent);
  for (std::size_t i = 0; i < 420; ++i) {  // Interleaved, as points of scans are.
    for (std::uint32_t id = 1; id <= kCount; ++id) {
      if (i < members[id].size()) moments.add(id, members[id][i]);
    }
  }
  const SupervoxelTable table = moments.table({});
  RC_ASSERT(table.size() == kCount + 1);
  for (std::uint32_t id = 1; id <= kCount; ++id) {
    const Truth truth = truth_of(members[id]);
    RC_ASSERT(moments.points(id) == members[id].size());
    double cosine = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      RC_ASSERT(std::abs(table.centroid[id][i] - truth.mean[static_cast<Eigen::Index>(i)]) <= slack);
      cosine += truth.normal[static_cast<Eigen::Index>(i)] * table.normal[id][i];
    }
    RC_ASSERT(std::abs(cosine) > 0.9999);
    RC_ASSERT(std::abs(table.thickness[id] - std::sqrt(truth.values[0])) < slack + 1e-4 * extent);
    const double area = 4.0 * kPi * std::sqrt(truth.values[1] * truth.values[2]);
    const double spacing = std::sqrt(area / static_cast<double>(members[id].size()));
    RC_ASSERT(std::abs(table.spacing[id] - spacing) < 1e-3 * spacing);
  }
}

TEST(SupervoxelMoments, PointsThatDefineNoPlane_HaveACentroidAndNothingElse) {
  SupervoxelMoments moments(6, 1000);
  moments.add(1, {7, -8, 9});
  for (int i = 0; i < 2; ++i) moments.add(2, {100 * i, 0, 0});
  for (int i = 0; i < 5; ++i) moments.add(3, {-5, 6, INT32_MAX});
  for (int i = 0; i < 9; ++i) moments.add(4, {3 * i, -2 * i, 5 * i});
  for (int i = 0; i < 9; ++i) moments.add(5, {10 * (i / 3), 10 * (i % 3), 0});  // A plane, for comparison.
  const SupervoxelTable table = moments.table({});
  for (const std::uint32_t id : {1U, 2U, 3U, 4U, 6U}) {
    EXPECT_EQ(table.normal[id], (std::array<float, 3>{})) << id;
    EXPECT_EQ(table.spacing[id], 0.0F) << id;
    EXPECT_EQ(table.thickness[id], 0.0F) << id;
  }
  EXPECT_EQ(table.centroid[1], (std::array<double, 3>{7, -8, 9}));
  EXPECT_EQ(table.centroid[2], (std::array<double, 3>{50, 0, 0}));
  EXPECT_EQ(table.centroid[3], (std::array<double, 3>{-5, 6, INT32_MAX}));
  EXPECT_EQ(table.centroid[4], (std::array<double, 3>{12, -8, 20}));
  EXPECT_EQ(moments.points(1), 1U);
  EXPECT_EQ(moments.points(2), 2U);
  EXPECT_EQ(moments.points(6), 0U);
  EXPECT_FLOAT_EQ(std::abs(table.normal[5][2]), 1.0F);
  EXPECT_GT(table.spacing[5], 0.0F);
}

TEST(SupervoxelMoments, GridsOfKnownSpacing_AreWithinAFewPercent) {
  struct Grid {
    int rows, columns;
  };
  for (const Grid grid : {Grid{40, 40}, Grid{20, 60}, Grid{12, 12}}) {
    SupervoxelMoments moments(1, 20'000);
    for (int i = 0; i < grid.rows; ++i) {
      for (int j = 0; j < grid.columns; ++j) moments.add(1, {60 * i, 100 * j, 80 * i});  // Tilted; 100 steps apart.
    }
    EXPECT_NEAR(moments.table({}).spacing[1], 100.0, 4.0) << grid.rows << " x " << grid.columns;
  }
}

TEST(SupervoxelMoments, MostBytes_CountsSumsOnlyWhereThereCanBeSeveralPoints) {
  const auto bytes = [](std::uint64_t points) { return SupervoxelMoments::most_bytes(1000, points, 0); };
  EXPECT_LT(bytes(1000), 70'000U);
  EXPECT_EQ(bytes(1010) - bytes(1000), 10U * 80);
  EXPECT_EQ(bytes(2000) - bytes(1000), 1000U * 80);
  EXPECT_EQ(bytes(1'000'000), bytes(2000));
  EXPECT_EQ(SupervoxelMoments::most_bytes(1000, 1000, 500) - bytes(1000), 4000U);
}

RC_GTEST_PROP(SupervoxelMoments, AnyAdjacency_IsListedFromBothSidesInOrder, ()) {
  const auto count = *rc::gen::inRange<std::uint32_t>(2, 40).as("supervoxels");
  std::set<std::pair<std::uint32_t, std::uint32_t>> chosen;
  const int wanted = *rc::gen::inRange(0, 200);
  for (int i = 0; i < wanted; ++i) {
    const auto a = *rc::gen::inRange<std::uint32_t>(1, count + 1);
    const auto b = *rc::gen::inRange<std::uint32_t>(1, count + 1);
    if (a != b) chosen.insert({std::min(a, b), std::max(a, b)});
  }
  SupervoxelMoments moments(count, 10);
  const SupervoxelTable table = moments.table(Pairs(chosen.begin(), chosen.end()));
  RC_ASSERT(table.begin.size() == count + 2);
  for (std::uint32_t a = 1; a <= count; ++a) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t b = 1; b <= count; ++b) {
      const bool adjacent = chosen.contains({std::min(a, b), std::max(a, b)});
      if (adjacent) expected.push_back(b);
      RC_ASSERT(table.adjacent(a, b) == adjacent);
    }
    RC_ASSERT(std::vector<std::uint32_t>(table.neighbours.begin() + table.begin[a],
                                         table.neighbours.begin() + table.begin[a + 1]) == expected);
  }
}

}  // namespace
}  // namespace arris::merge
