#include "tiling/lattice_choice.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "tiling/lattice_mapper.h"

namespace arris::tiling {
namespace {

io::SourceInfo las(std::array<double, 3> scale, std::array<double, 3> offset) {
  io::SourceInfo info;
  info.scaled_integers = true;
  info.scale = scale;
  info.offset = offset;
  return info;
}

io::SourceInfo ply() {
  io::SourceInfo info;
  info.format = io::Format::kPly;
  return info;
}

io::PointBatch integers(const std::vector<LatticePoint>& points) {
  io::PointBatch batch;
  batch.count = points.size();
  for (const LatticePoint& p : points) {
    batch.ix.push_back(p.x);
    batch.iy.push_back(p.y);
    batch.iz.push_back(p.z);
  }
  return batch;
}

io::PointBatch doubles(const std::vector<std::array<double, 3>>& points) {
  io::PointBatch batch;
  batch.count = points.size();
  for (const auto& p : points) {
    batch.x.push_back(p[0]);
    batch.y.push_back(p[1]);
    batch.z.push_back(p[2]);
  }
  return batch;
}

struct MappedBatch {
  std::vector<LatticePoint> positions;
  std::vector<Mapped> outcome;
};

MappedBatch map(const std::vector<io::SourceInfo>& sources, const Lattice& lattice, const io::PointBatch& batch,
                std::size_t source = 0) {
  MappedBatch result;
  LatticeMapper(sources, lattice).map(batch, source, result.positions, result.outcome);
  return result;
}

TEST(LatticeChoice, OneLas_IsItsOwnScaleAndOffset) {
  const std::vector sources{las({0.001, 0.001, 0.001}, {500000, 5e6, 100})};
  const LatticeChoice choice(sources, 0.0);
  EXPECT_FALSE(choice.needs_points());
  EXPECT_EQ(choice.lattice().step, 0.001);
  EXPECT_EQ(choice.lattice().origin, (std::array<double, 3>{500000, 5e6, 100}));
  const std::vector<LatticePoint> points{{0, -1, 2147483647}, {-2147483647 - 1, 5, 7}};
  const MappedBatch mapped = map(sources, choice.lattice(), integers(points));
  EXPECT_EQ(mapped.positions, points);
  EXPECT_EQ(mapped.outcome, (std::vector{Mapped::kOk, Mapped::kOk}));
}

TEST(LatticeChoice, AxesOfWholeMultiples_UseTheFinestExactly) {
  const std::vector sources{las({0.01, 0.01, 0.001}, {0, 0, 0})};
  LatticeChoice choice(sources, 0.0);
  ASSERT_TRUE(choice.needs_points());
  const auto batch = integers({{-3, 7, 11}, {100, 200, 300}});
  choice.add(batch, 0);
  EXPECT_EQ(choice.lattice().step, 0.001);
  EXPECT_EQ(choice.lattice().origin, (std::array<double, 3>{0, 0, 0}));
  EXPECT_EQ(map(sources, choice.lattice(), batch).positions,
            (std::vector<LatticePoint>{{-30, 70, 11}, {1000, 2000, 300}}));
}

TEST(LatticeChoice, MultiplesBeyondInt32_MoveTheOriginByWholeSteps) {
  // UTM coordinates at a centimetre without offset, heights at a millimetre: ten times the northing leaves int32.
  const std::vector sources{las({0.01, 0.01, 0.001}, {0, 0, 0})};
  LatticeChoice choice(sources, 0.0);
  const auto batch = integers({{50'000'000, 500'000'000, 100}, {50'000'001, 500'000'100, 101}});
  choice.add(batch, 0);
  const Lattice lattice = choice.lattice();
  EXPECT_EQ(lattice.step, 0.001);
  const MappedBatch mapped = map(sources, lattice, batch);
  EXPECT_EQ(mapped.outcome, (std::vector{Mapped::kOk, Mapped::kOk}));
  EXPECT_EQ(mapped.positions[1].x - mapped.positions[0].x, 10);
  EXPECT_EQ(mapped.positions[1].y - mapped.positions[0].y, 1000);
  EXPECT_EQ(mapped.positions[1].z - mapped.positions[0].z, 1);
  EXPECT_NEAR(lattice.world(1, mapped.positions[0].y), 5e6, 1e-6);
  EXPECT_EQ(lattice.origin[0], 0.0) << "x fits as it is";
}

TEST(LatticeChoice, FilesOfSeveralOffsets_ShareTheSmallestInAnyOrder) {
  const auto a = las({0.01, 0.01, 0.01}, {1000, 2000, 0}), b = las({0.01, 0.01, 0.01}, {500, 9000, 0});
  for (const auto& sources : {std::vector{a, b}, std::vector{b, a}}) {
    LatticeChoice choice(sources, 0.0);
    const std::size_t of_a = sources[0].offset == a.offset ? 0 : 1;
    const auto batch = integers({{1, 2, 3}});
    choice.add(batch, 0);
    choice.add(batch, 1);
    EXPECT_EQ(choice.lattice().origin, b.offset);
    EXPECT_TRUE(LatticeMapper(sources, choice.lattice()).by_integers(0));
    EXPECT_EQ(map(sources, choice.lattice(), batch, of_a).positions[0], (LatticePoint{50001, -699998, 3}));
    EXPECT_EQ(map(sources, choice.lattice(), batch, 1 - of_a).positions[0], (LatticePoint{1, 2, 3}));
  }
}

TEST(LatticeChoice, Doubles_AreRoundedToATenthOfAMillimetre) {
  const std::vector sources{ply()};
  LatticeChoice choice(sources, 0.0);
  const auto batch = doubles({{1.23456, -1.23456, 0.00005}, {2.0, 3.0, 4.0}});
  choice.add(batch, 0);
  const Lattice lattice = choice.lattice();
  EXPECT_EQ(lattice.step, kDefaultLatticeStep);
  const MappedBatch mapped = map(sources, lattice, batch);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(lattice.world(0, mapped.positions[i].x), batch.x[i], 0.000051);
    EXPECT_NEAR(lattice.world(1, mapped.positions[i].y), batch.y[i], 0.000051);
    EXPECT_NEAR(lattice.world(2, mapped.positions[i].z), batch.z[i], 0.000051);
  }
}

TEST(LatticeChoice, OriginOfDoubles_IsAWorldMultipleBelowTheMiddle) {
  LatticeChoice choice({ply()}, 0.0);
  choice.add(doubles({{500'100.0, -300.0, 0.0}, {500'200.0, -200.0, 1.0}}), 0);
  const Lattice lattice = choice.lattice();
  const std::array<double, 3> middle{500'150.0, -250.0, 0.5};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double multiples = lattice.origin[axis] / (65536 * lattice.step);
    EXPECT_NEAR(multiples, std::round(multiples), 1e-6);
    EXPECT_LE(lattice.origin[axis], middle[axis]);
    EXPECT_GT(lattice.origin[axis] + 65536 * lattice.step, middle[axis] - 1e-6);
  }
}

TEST(LatticeChoice, FewFarOutliers_AreLeftOut) {
  std::vector<std::array<double, 3>> points;
  for (int i = 0; i < 5000; ++i) points.push_back({0.001 * i, 1.0, 2.0});
  points.push_back({1e9, 1.0, 2.0});
  points.push_back({1.0, -3e15, 2.0});
  const std::vector sources{ply()};
  LatticeChoice choice(sources, 0.0);
  choice.add(doubles(points), 0);
  EXPECT_EQ(choice.lattice().step, kDefaultLatticeStep);
  const MappedBatch mapped = map(sources, choice.lattice(), doubles(points));
  for (std::size_t i = 0; i < 5000; ++i) ASSERT_EQ(mapped.outcome[i], Mapped::kOk);
  EXPECT_EQ(mapped.outcome[5000], Mapped::kOutOfRange);
  EXPECT_EQ(mapped.outcome[5001], Mapped::kOutOfRange);
}

TEST(LatticeChoice, ExtentBeyondTheLattice_EnlargesTheStepByTens) {
  const std::vector sources{ply()};
  LatticeChoice choice(sources, 0.0);
  const auto batch = doubles({{0, 0, 0}, {1e6, 0, 0}, {0.5e6, 1e9, 0}});  // 2^31 * 0.0001 = 214 748; 2^31 * 1 = 2.1e9.
  choice.add(batch, 0);
  EXPECT_NEAR(choice.lattice().step, 1.0, 1e-12);
  for (const Mapped mapped : map(sources, choice.lattice(), batch).outcome) EXPECT_EQ(mapped, Mapped::kOk);
}

TEST(LatticeChoice, NonFinite_IsReportedAndHasNoInfluence) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  const std::vector sources{ply()};
  LatticeChoice choice(sources, 0.0), clean(sources, 0.0);
  const auto batch = doubles({{1, 2, 3}, {kNan, 900, 0}, {0, -kInf, 0}, {0, 0, kInf}});
  choice.add(batch, 0);
  clean.add(doubles({{1, 2, 3}}), 0);
  EXPECT_EQ(choice.lattice().origin, clean.lattice().origin);
  EXPECT_EQ(map(sources, choice.lattice(), batch).outcome,
            (std::vector{Mapped::kOk, Mapped::kNonFinite, Mapped::kNonFinite, Mapped::kNonFinite}));
}

TEST(LatticeChoice, MixedScales_FallBackToDoublesOfTheSameWorld) {
  const std::vector sources{las({0.001, 0.001, 0.001}, {10, 0, 0}), las({0.0003, 0.0003, 0.0003}, {0, 0, 0}), ply()};
  LatticeChoice choice(sources, 0.0);
  const auto millimetres = integers({{-1000, 2000, 30}}), odd = integers({{30000, 6667, 100}});
  const auto world = doubles({{9.0, 2.0, 0.03}});
  choice.add(millimetres, 0);
  choice.add(odd, 1);
  choice.add(world, 2);
  const Lattice lattice = choice.lattice();
  EXPECT_EQ(lattice.step, kDefaultLatticeStep);
  EXPECT_EQ(map(sources, lattice, millimetres, 0).positions, map(sources, lattice, world, 2).positions);
  EXPECT_EQ(map(sources, lattice, odd, 1).positions[0].x, map(sources, lattice, world, 2).positions[0].x);
}

TEST(LatticeChoice, RequestedStep_IsUsedForLasToo) {
  const std::vector sources{las({0.001, 0.001, 0.001}, {0, 0, 0})};
  LatticeChoice choice(sources, 0.01);
  ASSERT_TRUE(choice.needs_points());
  choice.add(integers({{0, 0, 0}, {1000, 0, 0}}), 0);
  EXPECT_EQ(choice.lattice().step, 0.01);
  EXPECT_THROW(LatticeChoice(sources, -1.0), ConfigError);
  EXPECT_THROW(LatticeChoice(sources, std::numeric_limits<double>::quiet_NaN()), ConfigError);
  EXPECT_THROW(LatticeChoice(sources, 1e-12), ConfigError);
}

TEST(LatticeChoice, NoPoints_StillGivesALattice) {
  EXPECT_EQ(LatticeChoice({}, 0.0).lattice().step, kDefaultLatticeStep);
  EXPECT_EQ(LatticeChoice({ply()}, 0.0).lattice().origin, (std::array<double, 3>{0, 0, 0}));
}

RC_GTEST_PROP(LatticeChoice, AnyOrderOfDoubles_GivesTheSameLattice, ()) {
  auto points = *rc::gen::container<std::vector<std::array<double, 3>>>(
      rc::gen::map(rc::gen::arbitrary<std::array<std::int32_t, 3>>(), [](const std::array<std::int32_t, 3>& p) {
        return std::array<double, 3>{p[0] * 0.37, p[1] * 1e-3, std::ldexp(p[2], p[0] % 20)};
      }));
  LatticeChoice one({ply()}, 0.0), other({ply(), ply()}, 0.0);
  one.add(doubles(points), 0);
  std::ranges::reverse(points);
  const auto half = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 3);
  other.add(doubles({points.begin(), half}), 1);
  other.add(doubles({half, points.end()}), 0);
  RC_ASSERT(one.lattice().step == other.lattice().step);
  RC_ASSERT(one.lattice().origin == other.lattice().origin);
}

}  // namespace
}  // namespace arris::tiling
