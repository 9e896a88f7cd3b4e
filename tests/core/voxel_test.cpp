#include "core/voxel.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cstdint>
#include <limits>

#include "core/error.h"

namespace arris {
namespace {

constexpr std::int32_t kMin = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();

std::int64_t floor_divided(std::int64_t position, std::int64_t side) {
  return position / side - (position % side < 0 ? 1 : 0);
}

void expect_floor(std::int32_t side, std::int64_t position) {
  if (position < kMin || position > kMax) return;
  ASSERT_EQ(VoxelGrid(side).voxel_of(static_cast<std::int32_t>(position)), floor_divided(position, side))
      << position << " / " << side;
}

TEST(VoxelGrid, PositionsBesideEveryKindOfCorner_AreDividedDownwards) {
  for (std::int32_t side = 1; side <= kMostVoxelSide; side = side < 70 ? side + 1 : side + side / 7) {
    for (const std::int64_t around :
         {std::int64_t{kMin}, std::int64_t{kMin} / 2, std::int64_t{-side}, std::int64_t{0}, std::int64_t{side},
          std::int64_t{1} << 24, std::int64_t{kMax} / 3, std::int64_t{kMax}}) {
      const std::int64_t corner = floor_divided(around, side) * side;
      for (std::int64_t step = -2; step <= 2; ++step) {
        expect_floor(side, corner + step);
        expect_floor(side, corner + side + step);
        expect_floor(side, around + step);
      }
    }
  }
  expect_floor(kMostVoxelSide, kMin);
  expect_floor(kMostVoxelSide, kMax);
}

RC_GTEST_PROP(VoxelGrid, AnyPosition_IsDividedDownwards, (std::int32_t position)) {
  const auto side =
      *rc::gen::oneOf(rc::gen::inRange<std::int32_t>(1, 100), rc::gen::inRange<std::int32_t>(1, kMostVoxelSide + 1));
  const auto anywhere = *rc::gen::inRange<std::int64_t>(kMin, std::int64_t{kMax} + 1);
  const VoxelGrid grid(side);
  RC_ASSERT(grid.voxel_of(position) == floor_divided(position, side));
  const auto far = static_cast<std::int32_t>(anywhere);
  RC_ASSERT(grid.voxel_of(far) == floor_divided(far, side));
  RC_ASSERT(grid.corner(grid.voxel_of(far)) <= far);
  RC_ASSERT(grid.corner(grid.voxel_of(far)) + side > far);
}

TEST(VoxelGrid, SideOutOfRange_IsAConfigError) {
  EXPECT_THROW(VoxelGrid(0), ConfigError);
  EXPECT_THROW(VoxelGrid(-1), ConfigError);
  EXPECT_THROW(VoxelGrid(kMostVoxelSide + 1), ConfigError);
  EXPECT_EQ(VoxelGrid(kMostVoxelSide).side_steps(), kMostVoxelSide);
}

}  // namespace
}  // namespace arris
