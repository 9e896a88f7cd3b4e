#include "core/lattice.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdint>
#include <limits>

namespace arris {
namespace {

constexpr std::int32_t kMin = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();

TEST(LatticeBox, PointOnSharedFaceEdgeOrCorner_HasExactlyOneOwner) {
  int owners = 0;
  for (int x = 0; x < 2; ++x) {
    for (int y = 0; y < 2; ++y) {
      for (int z = 0; z < 2; ++z) {
        owners += LatticeBox{{x * 8 - 8, y * 8 - 8, z * 8 - 8}, {x * 8, y * 8, z * 8}}.contains({0, 0, 0});
      }
    }
  }
  EXPECT_EQ(owners, 1);
}

TEST(LatticeBox, LargestCoordinate_CanBeInside) {
  LatticeBox box;
  box.include(LatticePoint{kMax, kMin, 0});
  EXPECT_TRUE(box.contains({kMax, kMin, 0}));
  EXPECT_EQ(box.max[0], std::int64_t{kMax} + 1);
}

RC_GTEST_PROP(LatticeBox, Depth_IsTheLeastChebyshevDistanceToAnOutsidePosition, ()) {
  const auto coordinate = [] { return *rc::gen::inRange<std::int32_t>(-6, 7); };
  LatticeBox box;
  box.include(LatticePoint{coordinate(), coordinate(), coordinate()});
  box.include(LatticePoint{coordinate(), coordinate(), coordinate()});
  const LatticePoint p{coordinate(), coordinate(), coordinate()};
  std::int64_t least = 100;
  for (int x = -20; x <= 20; ++x) {
    for (int y = -20; y <= 20; ++y) {
      for (int z = -20; z <= 20; ++z) {
        if (box.contains({x, y, z})) continue;
        least = std::min<std::int64_t>(least, std::max({std::abs(x - p.x), std::abs(y - p.y), std::abs(z - p.z)}));
      }
    }
  }
  RC_ASSERT(box.depth(p) == least);
}

TEST(SquaredDistance, OppositeCornersOfTheLattice_DoesNotWrapPerAxis) {
  const std::uint64_t side = (std::uint64_t{1} << 32) - 1;
  EXPECT_EQ(squared_distance({kMin, 0, 0}, {kMax, 0, 0}), side * side);
}

RC_GTEST_PROP(Lattice, IndexOfWorld_ReturnsTheIndex, (std::int32_t index)) {
  const Lattice lattice{0.001, {512'345.678, 5'000'000.0, -17.25}};
  for (int axis = 0; axis < 3; ++axis) RC_ASSERT(lattice.index(axis, lattice.world(axis, index)) == index);
}

TEST(Lattice, HugeCoordinate_IsClampedNotUndefined) {
  const Lattice lattice;
  EXPECT_GT(lattice.index(0, 1e300), std::int64_t{kMax});
  EXPECT_LT(lattice.index(0, -1e300), std::int64_t{kMin});
}

}  // namespace
}  // namespace arris
