// The two tests of the method on neighbourhoods whose answer is known.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>
#include <random>

#include "core/columns.h"
#include "core/error.h"
#include "features/liu/fold_screen.h"
#include "features/liu/fold_test.h"
#include "features/liu/liu_method.h"
#include "features/neighbourhood/azimuth_gap.h"
#include "features/numerics/exact_math.h"

namespace arris {
namespace {

/// Neighbours at given azimuths in the plane z = 0; far ones come last, at height 10.
struct Ring {
  Neighbours neighbours;
  GapQuery query;
  Ring(const std::vector<double>& near_deg, const std::vector<double>& far_deg = {}) {
    query.u = {1, 0, 0};
    query.v = {0, 1, 0};
    query.near_count = near_deg.size();
    query.count = near_deg.size() + far_deg.size();
    neighbours.count = query.count;
    neighbours.reserve(query.count);
    for (std::size_t i = 0; i < query.count; ++i) {
      const bool far = i >= near_deg.size();
      const double a = (far ? far_deg[i - near_deg.size()] : near_deg[i]) / kDegreesPerRadian;
      neighbours.dx[i] = 100.0 * std::cos(a);
      neighbours.dy[i] = 100.0 * std::sin(a);
      neighbours.dz[i] = far ? 1000.0 : 0.0;
      neighbours.d2[i] = far ? 1010000.0 : 10000.0;
    }
  }
  GapResult operator()(double threshold, GapSpan span = GapSpan::kBracket) const {
    std::vector<AzimuthGapTest::Entry> scratch;
    const AzimuthGapTest test(threshold, span);
    const GapResult result = test(neighbours, query, scratch);
    const GapResult plain = test.without_rejection(neighbours, query, scratch);
    EXPECT_EQ(result.boundary_deg, plain.boundary_deg);
    EXPECT_EQ(result.weak_deg, plain.weak_deg);
    return result;
  }
};

TEST(AzimuthGap, HalfPlane_IsBoundaryWithItsOpening) {
  const Ring ring({0, 30, 60, 90, 120, 150, 180});
  EXPECT_NEAR(ring(120).boundary_deg, 180.0, 1e-9);
}

TEST(AzimuthGap, ConvexCorner_ReadsTheFullReflexGap) {
  const Ring ring({0, 20, 45, 70, 90});
  EXPECT_NEAR(ring(120).boundary_deg, 270.0, 1e-9);  // arccos of eq. 10 would say 90.
}

TEST(AzimuthGap, FullRing_IsNotBoundary) {
  const Ring ring({0, 45, 90, 135, 180, 225, 270, 315});
  EXPECT_EQ(ring(60).boundary_deg, 0.0);
  EXPECT_NEAR(ring(40).boundary_deg, 45.0, 1e-9);
}

TEST(AzimuthGap, GapAcrossZero_IsFound) {
  EXPECT_NEAR(Ring({80, 130, 190, 240, 280})(120).boundary_deg, 160.0, 1e-9);
}

TEST(AzimuthGap, RightAngle_ReachesARightAngle) {
  EXPECT_NEAR(Ring({0, 90, 180, 270})(90).boundary_deg, 90.0, 1e-9);
}

TEST(AzimuthGap, TwoAzimuths_AreNoEvidence) {
  EXPECT_EQ(Ring({0, 10})(120).boundary_deg, 0.0);
}

TEST(AzimuthGap, NeighboursAboveTheQuery_HaveNoAzimuth) {
  Ring ring({0, 120, 240, 10});
  ring.neighbours.dx[3] = ring.neighbours.dy[3] = 0.0;
  ring.neighbours.dz[3] = 5.0;
  ring.query.min_offset = 1e-3;
  EXPECT_NEAR(ring(120).boundary_deg, 120.0, 1e-9);
}

TEST(AzimuthGap, SecondLayerFillsTheGap_IsWeakBoundary) {
  const Ring ring({0, 45, 90, 135, 180}, {200, 230, 270, 300, 340});
  const GapResult bracket = ring(120);
  EXPECT_EQ(bracket.boundary_deg, 0.0);
  EXPECT_NEAR(bracket.weak_deg, 180.0, 1e-9);                     // Between the near neighbours at 180 and 360.
  EXPECT_NEAR(ring(120, GapSpan::kInner).weak_deg, 140.0, 1e-9);  // From 200 to 340.
  EXPECT_EQ(ring(150, GapSpan::kInner).weak_deg, 0.0);
  EXPECT_NEAR(ring(150).weak_deg, 180.0, 1e-9);
}

TEST(AzimuthGap, RandomRings_AgreeWithoutRejectionAndWhateverTheFrame) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> turn(0.0, 360.0);
  int boundaries = 0;
  for (int round = 0; round < 20000; ++round) {
    std::vector<double> near(3 + random() % 20);
    std::vector<double> far(random() % 10);
    for (double& a : near) a = round % 4 ? turn(random) : 15.0 * static_cast<double>(random() % 24);
    for (double& a : far) a = turn(random);
    Ring ring(near, far);
    const double threshold = std::vector<double>{40, 90, 120, 120.5, 200, 300}[random() % 6];
    const GapSpan span = random() % 2 ? GapSpan::kInner : GapSpan::kBracket;
    const GapResult result = ring(threshold, span);
    boundaries += result.boundary_deg > 0.0;
    ring.query.u = {-1, 0, 0};  // Signs of the frame mean nothing.
    const GapResult mirrored = ring(threshold, span);
    EXPECT_NEAR(result.boundary_deg, mirrored.boundary_deg, 1e-9);
    EXPECT_NEAR(result.weak_deg, mirrored.weak_deg, 1e-9);
  }
  EXPECT_GT(boundaries, 1000);
}

/// A ball of radius `r` around a point on the edge of a fold with interior angle `theta_deg`, sampled at `pitch`.
FoldScratch fold_ball(double theta_deg, double r, double pitch, const Eigen::Matrix3d& rotation) {
  FoldScratch s;
  const double half = 0.5 * theta_deg / kDegreesPerRadian;
  for (double along = -r; along <= r; along += pitch) {
    for (double out = 0.0; out <= r; out += pitch) {
      if (along * along + out * out > r * r) continue;
      for (const double side : {-1.0, 1.0}) {
        if (out == 0.0 && side > 0.0) continue;
        const Eigen::Vector3d p = rotation * Eigen::Vector3d(along, side * out * std::sin(half), out * std::cos(half));
        s.members.push_back(
            {p[0], p[1], p[2], p.squaredNorm(), s.members.size(), static_cast<std::uint32_t>(s.members.size())});
      }
    }
  }
  return s;
}

PrincipalFrame frame_of(const std::vector<BallMember>& members, BallMoments* out = nullptr) {
  BallMoments m;
  for (const BallMember& q : members) {
    m.n += 1;
    m.x += q.dx;
    m.y += q.dy;
    m.z += q.dz;
    m.xx += q.dx * q.dx;
    m.xy += q.dx * q.dy;
    m.xz += q.dx * q.dz;
    m.yy += q.dy * q.dy;
    m.yz += q.dy * q.dz;
    m.zz += q.dz * q.dz;
  }
  if (out) *out = m;
  return principal_frame(m.covariance());
}

const Eigen::Matrix3d kTurn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();

TEST(FoldTest, ExactFold_MeetsTheFoldLaw) {
  for (const double theta : {70.0, 90.0, 110.0, 130.0}) {
    FoldScratch s = fold_ball(theta, 100.0, 1.0, kTurn);
    FoldEmission emission;
    FoldThresholds t;
    t.radius = 100.0;
    t.cf1 = 1.0;
    evaluate_fold(frame_of(s.members), t, s, emission);
    ASSERT_EQ(emission.slots.size(), 3U) << theta;
    EXPECT_NEAR(emission.strength, kFoldLaw * 100.0 * std::cos(0.5 * theta / kDegreesPerRadian), 0.5) << theta;
    EXPECT_NEAR(emission.angle_deg, theta, 3.0);
  }
}

TEST(FoldTest, ExactFold_EmitsThePointsOnTheEdgeNearestToTheCentre) {
  FoldScratch s = fold_ball(90.0, 50.0, 5.0, kTurn);
  FoldEmission emission;
  FoldThresholds t;
  t.radius = 50.0;
  t.cf1 = 5.0;
  evaluate_fold(frame_of(s.members), t, s, emission);
  ASSERT_EQ(emission.slots.size(), 3U);
  std::vector<double> distances;
  for (const std::uint32_t slot : emission.slots) distances.push_back(std::sqrt(s.members[slot].d2));
  EXPECT_NEAR(distances[0], 0.0, 1e-9);  // All edge points tie; the centre is nearest to itself.
  EXPECT_NEAR(distances[1], 5.0, 1e-9);
  EXPECT_NEAR(distances[2], 5.0, 1e-9);
}

TEST(FoldTest, Plane_EmitsNothing) {
  FoldScratch s = fold_ball(180.0, 50.0, 5.0, kTurn);
  FoldEmission emission;
  FoldThresholds t;
  t.radius = 50.0;
  t.cf1 = 0.5;
  evaluate_fold(frame_of(s.members), t, s, emission);
  EXPECT_TRUE(emission.slots.empty());
}

TEST(FoldTest, FiveMembers_AreNoEvidence) {
  FoldScratch s = fold_ball(90.0, 50.0, 10.0, kTurn);
  s.members.resize(5);
  FoldEmission emission;
  FoldThresholds t{50.0, 1e-3, 1.0, 3};
  evaluate_fold(frame_of(s.members), t, s, emission);
  EXPECT_TRUE(emission.slots.empty());
}

TEST(FoldTest, MembersOnBothSides_FailTheSecondCriterion) {
  // An X: two crossing planes have as many members on either side of any chord.
  FoldScratch s = fold_ball(90.0, 50.0, 5.0, Eigen::Matrix3d::Identity());
  const std::size_t n = s.members.size();
  for (std::size_t i = 0; i < n; ++i) {
    BallMember m = s.members[i];
    if (m.dz == 0.0) continue;
    m.dz = -m.dz;
    m.id = m.slot = static_cast<std::uint32_t>(s.members.size());
    s.members.push_back(m);
  }
  FoldEmission emission;
  FoldThresholds t{50.0, 1.0, 4.0, 3};
  evaluate_fold(frame_of(s.members), t, s, emission);
  EXPECT_TRUE(emission.slots.empty());
  t.cf2 = 1.0;
  evaluate_fold(frame_of(s.members), t, s, emission);
  EXPECT_FALSE(emission.slots.empty());
}

/// Eq. 13-18 as read in the documentation: rotate e1 onto the z axis with a quaternion and look at x and y.
std::vector<double> distances_by_quaternion(const std::vector<BallMember>& members, Vector3 e1) {
  if (e1[2] < 0.0) e1 = {-e1[0], -e1[1], -e1[2]};
  const Vector3 u = cross({0, 0, 1}, e1);
  const double size = std::sqrt(dot(u, u));
  Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
  if (size > 1e-12) {
    const double half = 0.5 * std::acos(std::min(1.0, e1[2]));
    // The rotation that takes e1 to z is by -phi about u.
    r = Eigen::Quaterniond(std::cos(half), -std::sin(half) * u[0] / size, -std::sin(half) * u[1] / size,
                           -std::sin(half) * u[2] / size)
            .toRotationMatrix();
  }
  std::vector<Eigen::Vector2d> flat;
  for (const BallMember& m : members) flat.push_back((r * Eigen::Vector3d(m.dx, m.dy, m.dz)).head<2>());
  std::size_t a = 0;
  std::size_t b = 0;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    for (std::size_t j = i + 1; j < flat.size(); ++j) {
      if ((flat[i] - flat[j]).squaredNorm() > (flat[a] - flat[b]).squaredNorm() + 1e-9) {
        a = i;
        b = j;
      }
    }
  }
  const Eigen::Vector2d s = (flat[b] - flat[a]).normalized();
  std::vector<double> distances;
  for (const Eigen::Vector2d& p : flat)
    distances.push_back(std::fabs(s[0] * (p - flat[a])[1] - s[1] * (p - flat[a])[0]));
  return distances;
}

TEST(FoldTest, DirectProjection_AgreesWithTheQuaternionRoute) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 50; ++round) {
    const Eigen::Matrix3d turn = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                                     .normalized()
                                     .toRotationMatrix();
    FoldScratch s = fold_ball(95.0, 50.0, 7.0, turn);
    for (BallMember& m : s.members) {
      m.dx += 0.5 * normal(random);
      m.dy += 0.5 * normal(random);
      m.dz += 0.5 * normal(random);
      m.d2 = m.dx * m.dx + m.dy * m.dy + m.dz * m.dz;
    }
    const PrincipalFrame frame = frame_of(s.members);
    FoldEmission emission;
    evaluate_fold(frame, {60.0, 1.0, 1.0, 3}, s, emission);
    ASSERT_EQ(emission.slots.size(), 3U);
    const std::vector<double> expected = distances_by_quaternion(s.members, frame.e1);
    for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_NEAR(s.distance[i], expected[i], 1e-6);
    EXPECT_NEAR(s.distance[emission.slots[0]], *std::max_element(expected.begin(), expected.end()), 1e-6);
  }
}

TEST(FoldTest, DeviationBound_IsNeverBelowTheDeviation) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  int tight = 0;
  int tighter = 0;
  for (int round = 0; round < 300; ++round) {
    const double noise = std::vector<double>{0.0, 0.5, 3.0, 20.0}[round % 4];
    FoldScratch s = fold_ball(60.0 + round % 121, 50.0, 7.0, kTurn);
    for (BallMember& m : s.members) m.dx += noise * normal(random);
    BallMoments moments;
    const PrincipalFrame frame = frame_of(s.members, &moments);
    double radius = 0.0;
    double low[2] = {};
    double high[2] = {};
    for (BallMember& m : s.members) {
      m.d2 = m.dx * m.dx + m.dy * m.dy + m.dz * m.dz;
      radius = std::max(radius, std::sqrt(m.d2));
      const double along[2] = {dot(frame.e2, {m.dx, m.dy, m.dz}), dot(frame.e3, {m.dx, m.dy, m.dz})};
      for (int e = 0; e < 2; ++e) {
        low[e] = std::min(low[e], along[e]);
        high[e] = std::max(high[e], along[e]);
      }
    }
    FoldEmission emission;
    constexpr double kTiny = 1e-9;
    evaluate_fold(frame, {radius, kTiny, 1.0, 3}, s, emission);
    if (emission.slots.empty()) continue;
    const double cf1 = emission.strength * kTiny;
    EXPECT_GE(chord_deviation_bound(frame.values, moments.n, radius), cf1 * (1 - 1e-7));
    const double loose = chord_deviation_bound(frame.values, moments.n, radius, high[1] - low[1], 0.0);
    const double bound = chord_deviation_bound(frame.values, moments.n, radius, high[1] - low[1], high[0] - low[0]);
    EXPECT_GE(bound, cf1 * (1 - 1e-7));
    EXPECT_GE(loose, bound);
    tight += loose < 0.2 * radius;
    tighter += bound < 0.9 * loose;
  }
  EXPECT_GT(tight, 10);
  EXPECT_GT(tighter, 10);
}

TEST(FoldScreen, EightBalls_AreBoundedAsOneByOne) {
  std::mt19937_64 random(14);
  std::normal_distribution<double> normal;
  FoldScreen screen;
  int rejected = 0;
  for (int round = 0; round < 50; ++round) {
    BallMoments moments[FoldScreen::kCount];
    FoldThresholds thresholds[FoldScreen::kCount];
    for (std::size_t i = 0; i < FoldScreen::kCount; ++i) {
      FoldScratch s = fold_ball(60.0 + (round * 8 + static_cast<int>(i)) % 121, 50.0, 7.0, kTurn);
      for (BallMember& m : s.members) m.dx += 0.5 * static_cast<double>(i) * normal(random);
      frame_of(s.members, &moments[i]);
      thresholds[i] = {60.0, 4.0 + round % 20, 4.0, 3};
      screen.set(i, moments[i], thresholds[i]);
    }
    screen.solve();
    for (std::size_t i = 0; i < FoldScreen::kCount; ++i) {
      const SymmetricMatrix<double> c = moments[i].covariance();
      const Eigenvalues<double> values = eigenvalues_of(c);
      const SymmetricMatrix<double> screened = screen.covariance(i);
      EXPECT_EQ(std::tie(screened.xx, screened.xy, screened.xz, screened.yy, screened.yz, screened.zz),
                std::tie(c.xx, c.xy, c.xz, c.yy, c.yz, c.zz));
      EXPECT_EQ(screen.values(i).largest, values.largest);
      EXPECT_EQ(screen.values(i).middle, values.middle);
      EXPECT_EQ(screen.values(i).smallest, values.smallest);
      const bool may = chord_deviation_bound(values, moments[i].n, thresholds[i].radius) >= thresholds[i].cf1;
      EXPECT_EQ(screen.may_fold(i), may);
      rejected += !may;
    }
  }
  EXPECT_GT(rejected, 20);
  EXPECT_LT(rejected, 380);
}

TEST(LiuScore, MoreEvidence_ScoresHigher) {
  LiuParameters p;
  const auto with = [](std::uint8_t classes, float gap, std::uint32_t votes) {
    ContourRecord r;
    r.classes = classes;
    r.gap_deg = gap;
    r.votes = votes;
    return r;
  };
  EXPECT_FLOAT_EQ(liu_score(with(kBoundary, 120, 0), p), 0.5F);
  EXPECT_FLOAT_EQ(liu_score(with(kBoundary, 360, 0), p), 1.0F);
  EXPECT_FLOAT_EQ(liu_score(with(kBoundary, 240, 0), p), 0.75F);
  EXPECT_FLOAT_EQ(liu_score(with(kWeakBoundary, 240, 0), p), 0.375F);
  EXPECT_FLOAT_EQ(liu_score(with(kFold, 0, 3), p), 0.5F);
  EXPECT_FLOAT_EQ(liu_score(with(kFold | kBoundary, 240, 1), p), 0.75F);
  EXPECT_FLOAT_EQ(liu_score(with(0, 0, 0), p), 0.0F);
}

TEST(LiuHalo, Default_CoversTheBallAndTheNeighbours) {
  LiuParameters p;
  p.max_radius = 100.0;
  EXPECT_GT(liu_halo(p, 0.1), 0.6);
  EXPECT_LT(liu_halo(p, 0.1), 0.9);
  p.fold = false;
  EXPECT_GT(liu_halo(p, 0.1), 0.1 * std::sqrt(30 / kPi));
  EXPECT_LT(liu_halo(p, 0.1), 0.5);
  p.fold = true;
  p.radius = 2.0;
  EXPECT_DOUBLE_EQ(liu_halo(p, 0.01), 2.0);
  p.max_radius = 0.05;
  EXPECT_DOUBLE_EQ(liu_halo(p, 10.0), 0.05);
}

TEST(LiuParameters, OutOfRange_NamesTheOption) {
  const auto message = [](auto change) {
    LiuParameters p;
    p.max_radius = 1.0;
    validate(p);
    change(p);
    try {
      validate(p);
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(message([](auto& p) { p.k_min = 2; }).find("--k-min"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.k_max = 19; }).find("--k-max"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.k_max = 201; }).find("--k-max"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.k_step = 0; }).find("--k-step"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.gap_deg = 360; }).find("--gap"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.cf2 = NAN; }).find("--cf2"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.top_m = 65; }).find("--top"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.radius = 2.0; }).find("--radius"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.max_radius = 0; }).find("--max-radius"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.max_radius = INFINITY; }).find("--max-radius"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.spacing = -1; }).find("--spacing"), std::string::npos);
}

}  // namespace
}  // namespace arris
