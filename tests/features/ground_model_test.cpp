#include "features/ground/ground_model.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

namespace arris {
namespace {

using Point = std::array<double, 3>;

GroundModel model_of(const std::vector<Point>& points) {
  GroundSums sums;
  for (const auto& [x, y, z] : points) sums.add(x, y, z);
  return GroundModel(std::move(sums));
}

/// A square of random points, `spacing` apart on average, without those of a square hole in its middle.
struct Square {
  double low_x = 0.0, low_y = 0.0, side = 300.0, hole = 0.0, spacing = 0.7;
  bool in_hole(double x, double y) const {
    return std::max(std::abs(x - low_x - side / 2), std::abs(y - low_y - side / 2)) < hole / 2;
  }
  bool inside(double x, double y, double rim) const {
    return x >= low_x + rim && y >= low_y + rim && x <= low_x + side - rim && y <= low_y + side - rim;
  }
};
using Height = std::function<double(double x, double y)>;

std::vector<Point> sample(const Square& square, const Height& height) {
  std::mt19937 random(7);
  const auto along = [&] { return square.side * static_cast<double>(random()) / 0x1p32; };
  std::vector<Point> points;
  const double count = square.side * square.side / (square.spacing * square.spacing);
  for (int i = 0; i < static_cast<int>(count); ++i) {
    const double x = square.low_x + along();
    const double y = square.low_y + along();
    if (!square.in_hole(x, y)) points.push_back({x, y, height(x, y)});
  }
  return points;
}

/// Largest errors in the hole, elsewhere inside, within 10 units of the rim, and up to 30 units outside of it, there
/// against the height of the nearest point of the rim.
struct Errors {
  double hole = 0.0, inside = 0.0, rim = 0.0, beyond = 0.0;
};
Errors errors_of(const GroundModel& model, const Square& square, const Height& height) {
  Errors errors;
  for (double i = -30.0; i < square.side + 30.0; i += 0.93) {
    for (double j = -30.0; j < square.side + 30.0; j += 0.97) {
      const double x = square.low_x + i;
      const double y = square.low_y + j;
      const double truth = height(std::clamp(x, square.low_x, square.low_x + square.side),
                                  std::clamp(y, square.low_y, square.low_y + square.side));
      double& largest = !square.inside(x, y, 0.0)   ? errors.beyond
                        : square.in_hole(x, y)      ? errors.hole
                        : square.inside(x, y, 10.0) ? errors.inside
                                                    : errors.rim;
      largest = std::max(largest, std::abs(model.height_at(x, y) - truth));
    }
  }
  return errors;
}

Height plane(double slope, double at_x = 0.0, double at_y = 0.0) {
  return [=](double x, double y) { return 100.0 + slope * (x - at_x) + 0.4 * slope * (y - at_y); };
}

TEST(GroundModel, FlatGround_IsFlatEverywhere) {
  for (const double hole : {0.0, 150.0}) {
    const Square square{.low_x = -100.0, .low_y = 20.0, .hole = hole};
    const Height flat = [](double, double) { return 37.25; };
    const GroundModel model = model_of(sample(square, flat));
    EXPECT_EQ(model.cell_size(), 1.0);
    const Errors errors = errors_of(model, square, flat);
    for (const double error : {errors.hole, errors.inside, errors.rim, errors.beyond}) EXPECT_LT(error, 1e-9);
    EXPECT_NEAR(model.height_at(1e7, -1e7), 37.25, 1e-9);
  }
}

// Near the origin, across it, and where surveys are.
TEST(GroundModel, SlopeWithHoleOf60_ErrsByLittle) {
  for (const auto& [low_x, low_y] : {std::pair{0.0, 0.0}, {-140.0, -211.0}, {431234.5, 5412345.0}, {1e6, 1e7}}) {
    for (const double slope : {0.1, -0.7}) {
      const Square square{.low_x = low_x, .low_y = low_y, .hole = 60.0};
      const Height height = plane(slope, low_x, low_y);
      const Errors errors = errors_of(model_of(sample(square, height)), square, height);
      EXPECT_LT(errors.inside, 0.05 * std::abs(slope) + 0.005) << low_x;
      EXPECT_LT(errors.hole, 0.25 * std::abs(slope) + 0.005) << low_x;
      EXPECT_LT(errors.rim, 2.0 * std::abs(slope)) << low_x;
      EXPECT_LT(errors.beyond, 3.0 * std::abs(slope)) << low_x;
    }
  }
}

TEST(GroundModel, SparsePoints_AreSpanned) {
  const Square square{.low_x = 5012.0, .low_y = 333.0, .hole = 60.0, .spacing = 3.0};
  const Height height = plane(0.2, 5012.0, 333.0);
  const Errors errors = errors_of(model_of(sample(square, height)), square, height);
  EXPECT_LT(errors.inside, 0.1);
  EXPECT_LT(errors.hole, 0.1);
  EXPECT_LT(errors.rim, 2.0);
}

TEST(GroundModel, Cliff_IsSharpToFewCellsAndSpannedUnderAHole) {
  const Height cliff = [](double x, double) { return x < 150.5 ? 10.0 : 30.0; };
  const Square square{.hole = 40.0};
  const GroundModel model = model_of(sample(square, cliff));
  for (double y = 5.0; y < 295.0; y += 1.7) {
    if (std::abs(y - 150.0) < 24.0) continue;
    EXPECT_NEAR(model.height_at(148.5, y), 10.0, 2.0) << y;
    EXPECT_NEAR(model.height_at(152.5, y), 30.0, 2.0) << y;
    EXPECT_NEAR(model.height_at(146.0, y), 10.0, 0.2) << y;
    EXPECT_NEAR(model.height_at(155.0, y), 30.0, 0.2) << y;
  }
  for (double x = 131.0; x < 170.0; x += 1.1) {
    EXPECT_GE(model.height_at(x, 150.0), 10.0 - 1e-6);
    EXPECT_LE(model.height_at(x, 150.0), 30.0 + 1e-6);
    EXPECT_LE(model.height_at(x, 150.0), model.height_at(x + 1.1, 150.0) + 0.05) << "rises from one side to the other";
  }
}

TEST(GroundModel, RollingGround_IsFollowed) {
  const Height hills = [](double x, double y) { return 8.0 * std::sin(x / 40.0) * std::cos(y / 55.0); };
  const Square square{.low_x = 777.0, .low_y = -1234.0, .hole = 30.0};
  const Errors errors = errors_of(model_of(sample(square, hills)), square, hills);
  EXPECT_LT(errors.inside, 0.03);
  EXPECT_LT(errors.hole, 0.6);  // Bends of 1 / 200 under 15 units.
}

TEST(GroundModel, OnePoint_IsTheGroundEverywhere) {
  for (const Point& p : {Point{0.0, 0.0, 5.0}, {-3.5, 1e6, -2.0}, {5e8, -5e8, 1e6}, {0x1p34, -0x1p34, 0.0}}) {
    const GroundModel model = model_of({p});
    for (const double x : {-1e12, -1.0, 0.0, p[0], 1e12}) EXPECT_NEAR(model.height_at(x, p[1] + 3.0), p[2], 1.0 / 256);
  }
}

// Scanned from a corner of a building, with the origin there: one quadrant has no ground.
TEST(GroundModel, QuadrantWithoutGround_TakesItFromItsNeighbours) {
  const Height height = [](double x, double) { return x < 0.0 ? 1.0 : 2.0; };
  std::vector<Point> points = sample({.low_x = -50.0, .low_y = -50.0, .side = 100.0}, height);
  std::erase_if(points, [](const Point& p) { return p[0] > 0.0 && p[1] > 0.0; });
  const GroundModel model = model_of(points);
  for (double x = 1.0; x < 50.0; x += 3.1) {
    for (double y = 1.0; y < 50.0; y += 3.1) {
      EXPECT_GE(model.height_at(x, y), 1.0 - 1e-6);
      EXPECT_LE(model.height_at(x, y), 2.0 + 1e-6);
    }
  }
}

TEST(GroundSums, PointsThatAreNoPlaces_ChangeNothing) {
  const double nan = std::nan("");
  GroundSums sums;
  for (const double bad : {nan, HUGE_VAL, -HUGE_VAL, 1e11}) {
    sums.add(bad, 0.0, 0.0);
    sums.add(0.0, bad, 0.0);
    sums.add(0.0, 0.0, bad);
  }
  EXPECT_TRUE(sums.empty());
  sums.add(0.0, 0.0, 0.0);
  EXPECT_FALSE(sums.empty());
}

TEST(GroundModel, ScatteredIslands_KeepTheBound) {
  std::mt19937 random(3);
  GroundSums sums;
  for (int i = 0; i < 60000; ++i) {
    const auto at = [&] { return 2e6 * static_cast<double>(random()) / 0x1p32 - 1e6; };
    sums.add(at(), at(), 3.0);
    ASSERT_LE(sums.blocks().size(), GroundSums::kMostBlocks);
  }
  const int level = sums.level();
  EXPECT_GT(level, 0);
  const GroundModel model(std::move(sums));
  EXPECT_LE(model.blocks(), 2 * GroundSums::kMostBlocks + 4);
  EXPECT_GE(model.cell_size(), std::ldexp(1.0, level));
  EXPECT_NEAR(model.height_at(12345.0, -999999.0), 3.0, 1e-9);
}

/// Points in a few clusters, some far away, so that levels get coarser.
rc::Gen<std::vector<Point>> clusters() {
  return rc::gen::map(
      rc::gen::nonEmpty(rc::gen::container<std::vector<std::uint32_t>>(rc::gen::arbitrary<std::uint32_t>())),
      [](const std::vector<std::uint32_t>& seeds) {
        std::vector<Point> points;
        for (const std::uint32_t seed : seeds) {
          std::mt19937 random(seed);
          const double far = std::ldexp(1.0, static_cast<int>(seed % 24));
          const double x = far * (static_cast<double>(random()) / 0x1p31 - 1.0);
          const double y = far * (static_cast<double>(random()) / 0x1p31 - 1.0);
          for (int i = 0; i < 8; ++i) {
            points.push_back({x + static_cast<double>(random() % 64) * 0.37,
                              y + static_cast<double>(random() % 64) * 0.41,
                              static_cast<double>(random() % 1000) * 0.01});
          }
        }
        return points;
      });
}

RC_GTEST_PROP(GroundModelLaws, AnyOrderAndAnyParts_GiveTheSameHeights, ()) {
  std::vector<Point> points = *clusters();
  const GroundModel model = model_of(points);
  std::ranges::shuffle(points, std::mt19937(*rc::gen::arbitrary<std::uint32_t>()));
  const std::size_t cut = *rc::gen::inRange<std::size_t>(0, points.size() + 1);
  GroundSums first;
  GroundSums second;
  for (std::size_t i = 0; i < points.size(); ++i) {
    (i < cut ? first : second).add(points[i][0], points[i][1], points[i][2]);
  }
  // A part may be coarser than the other.
  if (*rc::gen::arbitrary<bool>()) std::swap(first, second);
  first.merge(second);
  const GroundModel merged(std::move(first));
  RC_ASSERT(merged.cell_size() == model.cell_size());
  for (const auto& [x, y, z] : points) {
    for (const double step : {0.0, 0.71, 33.3, 1e5})
      RC_ASSERT(merged.height_at(x + step, y - step) == model.height_at(x + step, y - step));
  }
}

TEST(GroundModelLaws, TooManyBlocks_AnyOrderGivesTheSameLevelAndHeights) {
  std::vector<Point> points;
  std::mt19937 random(5);
  for (int i = 0; i < 30000; ++i) {
    points.push_back({static_cast<double>(random() % 4000000) * 0.001 + 4e5,
                      static_cast<double>(random() % 4000000) * 0.001 + 5e6,
                      static_cast<double>(random() % 4096) * 0.01});
  }
  const GroundModel model = model_of(points);
  EXPECT_GT(model.cell_size(), 1.0);
  std::vector<Point> sorted = points;
  std::ranges::sort(sorted);
  const GroundModel other = model_of(sorted);
  GroundSums left;
  GroundSums right;
  for (const auto& [x, y, z] : points) (x < 4.003e5 ? left : right).add(x, y, z);
  EXPECT_LT(left.level(), right.level());
  left.merge(right);
  const GroundModel merged(std::move(left));
  for (const auto& [x, y, z] : points) {
    ASSERT_EQ(other.height_at(x, y), model.height_at(x, y));
    ASSERT_EQ(merged.height_at(x, y), model.height_at(x, y));
  }
}

}  // namespace
}  // namespace arris
