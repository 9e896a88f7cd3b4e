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

/// floor((position + side / 2) / side) in integers.
std::int64_t centred(std::int64_t position, std::int64_t side) {
  const std::int64_t from_corner = position + side / 2;
  return from_corner / side - (from_corner % side < 0 ? 1 : 0);
}

void expect_voxel(std::int32_t side, std::int64_t position) {
  if (position < kMin || position > kMax) return;
  ASSERT_EQ(VoxelGrid(side).voxel_of(static_cast<std::int32_t>(position)), centred(position, side))
      << position << " / " << side;
}

TEST(VoxelGrid, PositionsBesideEveryKindOfCorner_AreInTheVoxelCentredThere) {
  for (std::int32_t side = 1; side <= kMostVoxelSide; side = side < 70 ? side + 1 : side + side / 7) {
    for (const std::int64_t around :
         {std::int64_t{kMin}, std::int64_t{kMin} / 2, std::int64_t{-side}, std::int64_t{0}, std::int64_t{side},
          std::int64_t{1} << 24, std::int64_t{kMax} / 3, std::int64_t{kMax}}) {
      const std::int64_t corner = centred(around, side) * side - side / 2;
      for (std::int64_t step = -2; step <= 2; ++step) {
        expect_voxel(side, corner + step);
        expect_voxel(side, corner + side + step);
        expect_voxel(side, around + step);
      }
    }
  }
  expect_voxel(kMostVoxelSide, kMin);
  expect_voxel(kMostVoxelSide, kMax);
}

RC_GTEST_PROP(VoxelGrid, AnyPosition_IsInTheVoxelCentredThere, (std::int32_t position)) {
  const auto side =
      *rc::gen::oneOf(rc::gen::inRange<std::int32_t>(1, 100), rc::gen::inRange<std::int32_t>(1, kMostVoxelSide + 1));
  const auto anywhere = *rc::gen::inRange<std::int64_t>(kMin, std::int64_t{kMax} + 1);
  const VoxelGrid grid(side);
  RC_ASSERT(grid.voxel_of(position) == centred(position, side));
  const auto far = static_cast<std::int32_t>(anywhere);
  RC_ASSERT(grid.voxel_of(far) == centred(far, side));
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
