// The closed-form numerics against the standard library, Eigen and brute force.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>
#include <tuple>

#include "features/liu/entropy_scale.h"
#include "features/liu/scale_batch.h"
#include "features/neighbourhood/planar_diameter.h"
#include "features/numerics/exact_math.h"
#include "features/numerics/fixed_point.h"
#include "features/numerics/principal_frames.h"
#include "features/numerics/sorting_network.h"
#include "features/numerics/symmetric_eigen3.h"
#include "features/numerics/transpose.h"

namespace arris {
namespace {

TEST(ExactMath, Logarithm_AgreesWithStandardLibrary) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-690.0, 690.0);
  for (int i = 0; i < 20000; ++i) {
    const double x = i % 2 ? std::exp(exponent(random)) : 1.0 + 1e-3 * exponent(random) / 690.0;
    EXPECT_NEAR(log_of_positive(x), std::log(x), 4e-16 * std::max(1.0, std::fabs(std::log(x)))) << x;
  }
  EXPECT_EQ(log_of_positive(1.0), 0.0);
}

TEST(ExactMath, VectorLogarithm_HasTheBitsOfTheScalar) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    simd::Wide<64>::Double x;
    for (int lane = 0; lane < 8; ++lane) x[lane] = unit(random);
    const simd::Wide<64>::Double y = log_of_positive(x);
    for (int lane = 0; lane < 8; ++lane) EXPECT_EQ(y[lane], log_of_positive(static_cast<double>(x[lane])));
  }
}

TEST(ExactMath, Angle_AgreesWithStandardLibrary) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20000; ++i) {
    const double x = normal(random) * (i % 3 ? 1.0 : 1e-9);
    const double y = normal(random);
    EXPECT_NEAR(angle_of(y, x), std::atan2(y, x), 1e-15 * 4);
  }
  EXPECT_EQ(angle_of(0.0, 0.0), 0.0);
  EXPECT_EQ(angle_of(0.0, -2.0), kPi);
  EXPECT_EQ(angle_of(3.0, 0.0), kPi / 2);
  EXPECT_NEAR(arc_cosine(0.3), std::acos(0.3), 1e-15);
  EXPECT_EQ(arc_cosine(2.0), 0.0);
}

TEST(FixedPoint, SumsOfRoundedValues_DoNotDependOnOrder) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0.0, 7.7);
  for (const std::size_t n : {3, 100, 100000}) {
    const FixedPoint fixed(7.7, n, 50);
    std::vector<double> values(n);
    for (double& v : values) v = fixed.rounded(unit(random));
    double forward = 0.0;
    double backward = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      forward += values[i];
      backward += values[n - 1 - i];
    }
    EXPECT_EQ(forward, backward);
    EXPECT_NEAR(fixed.rounded(1.234567), 1.234567, 1e-9);
  }
}

Eigen::Matrix3d matrix(const SymmetricMatrix<double>& a) {
  Eigen::Matrix3d m;
  m << a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz;
  return m;
}

/// Random rotations of given eigenvalues.
SymmetricMatrix<double> rotated(const Eigen::Vector3d& values, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Eigen::Matrix3d q = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                                .normalized()
                                .toRotationMatrix();
  const Eigen::Matrix3d m = q * values.asDiagonal() * q.transpose();
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
}

TEST(SymmetricEigen3, AnyMatrix_AgreesWithEigen) {
  std::mt19937_64 random(5);
  const Eigen::Vector3d spectra[] = {{3, 2, 1},       {1, 1, 0},      {1, 1, 1e-9}, {1, 0.2, 0},
                                     {1, 1e-3, 1e-6}, {1, 0, 0},      {1, 1, 1},    {1, 0.999999, 0.1},
                                     {1e6, 1e5, 1},   {5, 4.9999, 0}, {1, 1e-9, 0}};
  for (const Eigen::Vector3d& spectrum : spectra) {
    for (int i = 0; i < 200; ++i) {
      const SymmetricMatrix<double> a = rotated(spectrum, random);
      const PrincipalFrame frame = principal_frame(a);
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix(a));
      const double scale = spectrum.maxCoeff();
      EXPECT_NEAR(frame.values.largest, solver.eigenvalues()[2], 3e-8 * scale);
      EXPECT_NEAR(frame.values.middle, solver.eigenvalues()[1], 3e-8 * scale);
      EXPECT_NEAR(frame.values.smallest, solver.eigenvalues()[0], 3e-8 * scale);
      EXPECT_GE(frame.values.largest, frame.values.middle);
      EXPECT_GE(frame.values.middle, frame.values.smallest);
      Eigen::Matrix3d e;
      for (int r = 0; r < 3; ++r) e.row(r) << frame.e1[r], frame.e2[r], frame.e3[r];
      EXPECT_LT((e.transpose() * e - Eigen::Matrix3d::Identity()).norm(), 1e-13);
      EXPECT_GT(e.determinant(), 0.0);
      // The frame makes the matrix diagonal, in descending order.
      const Eigen::Matrix3d d = e.transpose() * matrix(a) * e;
      EXPECT_LT(std::fabs(d(0, 1)) + std::fabs(d(0, 2)) + std::fabs(d(1, 2)), 1e-7 * scale) << spectrum.transpose();
      EXPECT_GE(d(0, 0), d(1, 1) - 1e-7 * scale);
      EXPECT_GE(d(1, 1), d(2, 2) - 1e-7 * scale);
    }
  }
}

TEST(SymmetricEigen3, ExactPlane_HasAnExactNormal) {
  // Noise-free and tilted: the smallest value is rounding only and the normal is right to 1e-12.
  SymmetricMatrix<double> a{};
  double n = 0;
  double s[3] = {};
  for (int u = -3; u <= 3; ++u) {
    for (int v = -2; v <= 5; ++v) {
      const double p[3] = {2.0 * u, 3.0 * v, 2.0 * u - 6.0 * v};  // x - 2 y - z = 0.
      n += 1;
      for (int c = 0; c < 3; ++c) s[c] += p[c];
      a.xx += p[0] * p[0];
      a.xy += p[0] * p[1];
      a.xz += p[0] * p[2];
      a.yy += p[1] * p[1];
      a.yz += p[1] * p[2];
      a.zz += p[2] * p[2];
    }
  }
  a = {n * a.xx - s[0] * s[0], n * a.xy - s[0] * s[1], n * a.xz - s[0] * s[2],
       n * a.yy - s[1] * s[1], n * a.yz - s[1] * s[2], n * a.zz - s[2] * s[2]};
  const PrincipalFrame frame = principal_frame(a);
  EXPECT_NEAR(frame.values.smallest / frame.values.largest, 0.0, 1e-14);
  EXPECT_NEAR(std::fabs(dot(frame.e3, {1.0, -2.0, -1.0})), std::sqrt(6.0), 1e-12);
}

TEST(ExactMath, ShortLogarithm_IsRightToAFloat) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-80.0, 80.0);
  for (int i = 0; i < 20000; ++i) {
    const auto x = static_cast<float>(i % 2 ? std::exp(exponent(random)) : 1.0 + 1e-3 * exponent(random));
    const double expected = std::log(static_cast<double>(x));
    EXPECT_NEAR(short_log_of_positive<double>(x), expected, 2e-7 * std::max(1.0, std::fabs(expected))) << x;
    simd::Wide<32>::Float lanes = {x, 1.0F, x, x, 0.5F, x, x, x};
    EXPECT_EQ(short_log_of_positive<simd::Wide<64>::Double>(lanes)[3], short_log_of_positive<double>(x));
  }
}

TEST(Entropy, PureShapes_HaveNone) {
  EXPECT_NEAR(entropy_of(Eigenvalues<double>{1, 0, 0}), 0.0, 3e-7);
  EXPECT_NEAR(entropy_of(Eigenvalues<double>{1, 1, 0}), 0.0, 3e-7);
  EXPECT_NEAR(entropy_of(Eigenvalues<double>{1, 1, 1}), 0.0, 3e-7);
  EXPECT_TRUE(std::isinf(entropy_of(Eigenvalues<double>{0, 0, 0})));
}

TEST(Entropy, EqualShares_HaveTheMost) {
  // a1 = a2 = a3 = 1/3 means delta = 3 : 2 : 1.
  EXPECT_NEAR(entropy_of(Eigenvalues<double>{9, 4, 1}), std::log(3.0), 3e-7);
  EXPECT_NEAR(entropy_of(Eigenvalues<double>{900, 400, 100}), std::log(3.0), 3e-7);
}

Neighbours neighbours_of(const std::vector<Vector3>& points) {
  Neighbours n;
  n.reserve(std::max<std::size_t>(points.size(), 64));
  n.count = points.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    n.dx[i] = points[i][0];
    n.dy[i] = points[i][1];
    n.dz[i] = points[i][2];
    n.d2[i] = dot(points[i], points[i]);
  }
  return n;
}

/// What ScaleBatch does, one query at a time.
namespace one_by_one {

/// First and second moments of a growing set, relative to the query.
struct RunningMoments {
  double x = 0, y = 0, z = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  void add(double dx, double dy, double dz) {
    x += dx;
    y += dy;
    z += dz;
    xx += dx * dx;
    xy += dx * dy;
    xz += dx * dz;
    yy += dy * dy;
    yz += dy * dz;
    zz += dz * dz;
  }
  /// n² times the covariance.
  SymmetricMatrix<double> scaled_covariance(double n) const {
    return {n * xx - x * x, n * xy - x * y, n * xz - x * z, n * yy - y * y, n * yz - y * z, n * zz - z * z};
  }
};

/// The running minimum over ascending k.
struct Best {
  double entropy = std::numeric_limits<double>::infinity();
  ScaleChoice choice;

  void offer(double e, const ScaleChoice& other) {
    if (!(e < entropy - kEntropyTie)) return;
    entropy = e;
    choice = other;
  }
};

ScaleChoice choose_scale(const Neighbours& neighbours, const ScaleRange& range) {
  const int last = std::min(range.k_max, static_cast<int>(neighbours.count));
  Best planar;
  Best any;
  RunningMoments moments;
  std::size_t added = 0;
  for (int k = range.k_min; k <= last; k += range.k_step) {
    for (; added < static_cast<std::size_t>(k); ++added) {
      moments.add(neighbours.dx[added], neighbours.dy[added], neighbours.dz[added]);
    }
    ScaleChoice choice;
    choice.k = k;
    choice.covariance = moments.scaled_covariance(k + (range.with_target ? 1 : 0));
    choice.values = eigenvalues_of(choice.covariance);
    const double entropy = entropy_of(choice.values);
    any.offer(entropy, choice);
    if (choice.values.middle >= range.min_planarity * choice.values.largest) planar.offer(entropy, choice);
  }
  return planar.choice.k > 0 ? planar.choice : any.choice;
}

}  // namespace one_by_one

ScaleChoice choose_scale(const Neighbours& neighbours, const ScaleRange& range) {
  ScaleBatch batch(range);
  batch.set(3, neighbours);
  batch.solve();
  return batch.choice(3);
}

TEST(ChooseScale, ManySizes_AgreeWithOneByOne) {
  std::mt19937_64 random(6);
  std::uniform_int_distribution<int> step(-500, 500);
  for (int round = 0; round < 100; ++round) {
    std::vector<Vector3> points(60);
    for (Vector3& p : points) p = {1.0 * step(random), 1.0 * step(random), 0.1 * round * step(random) / 5};
    for (Vector3& p : points) p[2] = std::round(p[2]);
    std::sort(points.begin(), points.end(), [](const Vector3& a, const Vector3& b) { return dot(a, a) < dot(b, b); });
    const Neighbours n = neighbours_of(points);
    const ScaleRange range{10, 60, 1, round % 2 == 0, 0.05};
    const ScaleChoice choice = choose_scale(n, range);
    double best = 1e300;
    int best_k = 0;
    for (int k = range.k_min; k <= range.k_max; ++k) {
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      Eigen::Matrix3d c = Eigen::Matrix3d::Zero();
      const int total = k + range.with_target;
      for (int j = 0; j < k; ++j) mean += Eigen::Vector3d(points[j].data()) / total;
      for (int j = 0; j < k; ++j) {
        const Eigen::Vector3d d = Eigen::Vector3d(points[j].data()) - mean;
        c += d * d.transpose();
      }
      if (range.with_target) c += mean * mean.transpose();
      const Eigen::Vector3d l = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(c).eigenvalues();
      if (l[1] < 0.05 * l[2]) continue;
      const double entropy = entropy_of(Eigenvalues<double>{l[2], l[1], l[0]});
      if (entropy < best - kEntropyTie) {
        best = entropy;
        best_k = k;
      }
    }
    EXPECT_EQ(choice.k, best_k);
  }
}

TEST(ChooseScale, ScanLineAmongNeighbours_IsNotChosen) {
  // The first 20 lie on a line, which has no entropy at all; the guard prefers the plane that the rest adds.
  std::vector<Vector3> points;
  for (int i = 1; i <= 10; ++i) {
    points.push_back({1.0 * i, 0, 0});
    points.push_back({-1.0 * i, 0, 0});
  }
  for (int i = 0; i < 10; ++i) points.push_back({2.0 * i - 9, i % 2 ? 11.0 : -11.0, 0});
  EXPECT_GT(choose_scale(neighbours_of(points), ScaleRange{}).k, 20);
  ScaleRange unguarded;
  unguarded.min_planarity = 0.0;
  EXPECT_EQ(choose_scale(neighbours_of(points), unguarded).k, 20);
}

TEST(ChooseScale, TooFewNeighbours_GiveNone) {
  EXPECT_EQ(choose_scale(neighbours_of({{1, 0, 0}, {0, 1, 0}}), ScaleRange{}).k, 0);
}

TEST(ChooseScale, ExactPlane_TiesGoToTheSmallest) {
  // A regular hexagon's shells: isotropic at every size, so entropy is 0 but for rounding.
  std::vector<Vector3> points;
  for (int shell = 1; shell <= 5; ++shell) {
    for (const Vector3& corner : {Vector3{2, 0, 0}, Vector3{-2, 0, 0}, Vector3{0, 2, 0}, Vector3{0, -2, 0}}) {
      points.push_back({corner[0] * shell, corner[1] * shell, 0});
    }
  }
  EXPECT_EQ(choose_scale(neighbours_of(points), ScaleRange{4, 20, 4, true, 0.05}).k, 4);
}

TEST(ScaleBatch, EightQueries_AreChosenAsOneByOne) {
  std::mt19937_64 random(16);
  std::uniform_int_distribution<int> step(-500, 500);
  std::uniform_int_distribution<std::size_t> count(5, 45);
  for (int round = 0; round < 100; ++round) {
    const ScaleRange range{10 + round % 7, 40, 1 + round % 3, round % 2 == 0, round % 5 == 0 ? 0.9 : 0.05};
    ScaleBatch batch(range);
    std::vector<Neighbours> all;
    for (std::size_t i = 0; i < ScaleBatch::kCount; ++i) {
      std::vector<Vector3> points(count(random));
      const double flat = std::vector<double>{0.0, 0.02, 1.0}[i % 3];  // Also exact planes and lines.
      for (Vector3& p : points)
        p = {1.0 * step(random), i == 7 ? 0.0 : 1.0 * step(random), std::round(flat * step(random))};
      std::sort(points.begin(), points.end(), [](const Vector3& a, const Vector3& b) { return dot(a, a) < dot(b, b); });
      all.push_back(neighbours_of(points));
      batch.set(i, all.back());
    }
    batch.solve();
    for (std::size_t i = 0; i < ScaleBatch::kCount; ++i) {
      const ScaleChoice a = batch.choice(i);
      const ScaleChoice b = one_by_one::choose_scale(all[i], range);
      EXPECT_EQ(a.k, b.k);
      if (b.k == 0) continue;
      EXPECT_EQ(std::tie(a.covariance.xx, a.covariance.xy, a.covariance.xz, a.covariance.yy, a.covariance.yz,
                         a.covariance.zz, a.values.largest, a.values.middle, a.values.smallest),
                std::tie(b.covariance.xx, b.covariance.xy, b.covariance.xz, b.covariance.yy, b.covariance.yz,
                         b.covariance.zz, b.values.largest, b.values.middle, b.values.smallest));
    }
  }
}

TEST(PrincipalFrames, EightMatrices_AreSolvedAsOneByOne) {
  std::mt19937_64 random(15);
  std::uniform_int_distribution<int> entry(-4, 4);
  std::normal_distribution<double> normal;
  PrincipalFrames frames;
  for (int round = 0; round < 500; ++round) {
    SymmetricMatrix<double> a[PrincipalFrames::kCount];
    for (std::size_t i = 0; i < PrincipalFrames::kCount; ++i) {
      // Small integers: also double and triple eigenvalues, diagonal and zero matrices.
      double e[6];
      for (double& v : e) v = i % 2 == 0 ? entry(random) * (entry(random) > 0) : normal(random);
      a[i] = {e[0], e[1], e[2], e[3], e[4], e[5]};
      if (i == 0) a[i] = {e[0], 0, 0, e[0], 0, e[0]};
      if (i == 2) a[i] = {e[0], 0, 0, e[1], 0, e[1]};
      frames.set(i, a[i], eigenvalues_of(a[i]));
    }
    frames.solve();
    for (std::size_t i = 0; i < PrincipalFrames::kCount; ++i) {
      const PrincipalFrame one = principal_frame(a[i]);
      const PrincipalFrame eight = frames.frame(i);
      EXPECT_EQ(eight.e1, one.e1);
      EXPECT_EQ(eight.e2, one.e2);
      EXPECT_EQ(eight.e3, one.e3);
    }
  }
}

TEST(PlanarDiameter, RandomSets_AgreeWithAllPairs) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> small(-3, 3);
  std::vector<PlanarPoint> hull;
  for (int round = 0; round < 3000; ++round) {
    const bool tied = round % 2 == 1;
    std::vector<PlanarPoint> points(2 + round % 40);
    for (std::size_t i = 0; i < points.size(); ++i) {
      PlanarPoint& p = points[i];
      p.x = tied ? small(random) : normal(random);
      p.y = tied ? small(random) : (round % 3 ? normal(random) : 1e-3 * normal(random));
      p.d2 = p.x * p.x + p.y * p.y;
      p.id = (i * 7919) % 1009;
    }
    // All pairs in canonical order: the first of the longest.
    std::vector<PlanarPoint> sorted = points;
    std::sort(sorted.begin(), sorted.end(),
              [](const auto& a, const auto& b) { return a.d2 != b.d2 ? a.d2 < b.d2 : a.id < b.id; });
    Diameter expected;
    for (std::size_t a = 0; a < sorted.size(); ++a) {
      for (std::size_t b = a + 1; b < sorted.size(); ++b) {
        const double dx = sorted[a].x - sorted[b].x;
        const double dy = sorted[a].y - sorted[b].y;
        const double length2 = dx * dx + dy * dy;
        if (length2 > expected.length2) expected = {sorted[a], sorted[b], length2};
      }
    }
    std::shuffle(points.begin(), points.end(), random);
    const Diameter found = planar_diameter(points, hull);
    ASSERT_EQ(found.length2, expected.length2) << round;
    if (expected.length2 == 0.0) continue;
    ASSERT_EQ(found.a.id, expected.a.id) << round;
    ASSERT_EQ(found.b.id, expected.b.id) << round;
  }
}

/// Of rotated lattices: lines of three and more points, parallel sides and places next to each other but for rounding.
TEST(PlanarDiameter, RotatedLattices_AgreeWithAllPairsButForRounding) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> angle(0.0, 3.2);
  std::vector<PlanarPoint> hull;
  for (int round = 0; round < 20'000; ++round) {
    std::uniform_int_distribution<int> wide(-8, 8), narrow(-1 - round % 4, 1 + round % 4);
    const double c = std::cos(angle(random)), s = std::sin(angle(random)), skew = round % 3 == 0 ? 0.0 : angle(random);
    std::vector<PlanarPoint> points(4 + static_cast<std::size_t>(round) % 60);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double x = wide(random), y = narrow(random), behind = 1e-16 * wide(random);
      points[i] = {c * x - s * y + behind, s * x + c * (y + skew * x) - behind, 0.0, i};
    }
    double longest2 = 0.0;
    for (const PlanarPoint& a : points)
      for (const PlanarPoint& b : points)
        longest2 = std::max(longest2, (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
    const Diameter found = planar_diameter(points, hull);
    ASSERT_LE(found.length2, longest2) << round;
    ASSERT_GE(found.length2, longest2 * (1.0 - 1e-12)) << round;
  }
}

TEST(PlanarDiameter, CoincidentPoints_HaveNone) {
  std::vector<PlanarPoint> points(5, PlanarPoint{1.0, 2.0, 0.0, 0});
  std::vector<PlanarPoint> hull;
  EXPECT_EQ(planar_diameter(points, hull).length2, 0.0);
  points.clear();
  EXPECT_EQ(planar_diameter(points, hull).length2, 0.0);
}

TEST(RankNetwork, RanksAsked_AreWhereSortingPutsThem) {
  std::mt19937 random(4);
  for (int round = 0; round < 500; ++round) {
    std::int32_t lanes[4][32];
    simd::Wide<16>::Int values[32];
    for (int lane = 0; lane < 4; ++lane) {
      const auto distinct = 1 + random() % (round % 2 == 0 ? 2 : 1000);  // Networks that sort zeros and ones sort all.
      for (int i = 0; i < 32; ++i) lanes[lane][i] = values[i][lane] = static_cast<std::int32_t>(random() % distinct);
      std::sort(std::begin(lanes[lane]), std::end(lanes[lane]));
    }
    RankNetwork<32, 11, 20>::run(values);
    for (int lane = 0; lane < 4; ++lane) {
      for (int i = 11; i <= 20; ++i) ASSERT_EQ(values[i][lane], lanes[lane][i]);
    }
  }
}

TEST(Transpose, Rows_BecomeColumns) {
  simd::Wide<32>::Int rows[8];
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) rows[i][j] = 8 * i + j;
  }
  simd::transpose<8>(rows);
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) EXPECT_EQ(rows[i][j], 8 * j + i);
  }
}

}  // namespace
}  // namespace arris
