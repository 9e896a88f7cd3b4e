#include "tiling/voxel_file.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "support/temp_folder.h"

namespace arris::tiling {
namespace {

/// Any voxel of a grid, at the ends of what centroids can be.
Voxel voxel_at(std::uint32_t rank, std::int32_t side_steps, bool colours) {
  const std::uint32_t most = static_cast<std::uint32_t>(side_steps - 1) * kVoxelFractions;
  Voxel voxel{{}, {rank % 2 == 0 ? most : 0, most / 2, rank % (most + 1)}, {}};
  if (colours) voxel.colour = {65535, 0, static_cast<std::uint16_t>(rank)};
  return voxel;
}

TEST(VoxelFile, NarrowAndWideVoxelsWithAndWithoutColours_AreReadAsWritten) {
  constexpr std::uint32_t kVoxels = 5 * VoxelFile::kChunkVoxels + 7;
  for (const std::int32_t side : {1, 300, 4096, 4097, kMostVoxelSide}) {
    for (const bool colours : {false, true}) {
      const test::TempFolder folder;
      const VoxelLayout layout(VoxelGrid(side), colours);
      EXPECT_EQ(layout.bytes(), (side <= 4096 ? 6U : 12U) + (colours ? 6U : 0U));
      VoxelFile file(folder / "voxels", 2 * VoxelFile::kChunkVoxels * layout.bytes(), layout);
      std::vector<Voxel> all;
      for (std::uint32_t rank = 0; rank < kVoxels; ++rank) all.push_back(voxel_at(rank, side, colours));
      // Pieces of all sizes, some longer than the buffer.
      for (std::size_t begin = 0, piece = 0; begin < all.size(); begin += piece, piece = 2 * piece + 1)
        file.append(std::span<const Voxel>(all).subspan(begin, std::min(piece, all.size() - begin)));
      file.finish();
      EXPECT_EQ(file.size_bytes(), kVoxels * layout.bytes());
      constexpr std::size_t kFirst = 3;
      std::vector<Voxel> voxels(kVoxels - kFirst * VoxelFile::kChunkVoxels);
      file.read(kFirst, voxels);
      for (std::uint32_t i = 0; i < voxels.size(); ++i)
        ASSERT_EQ(voxels[i], voxel_at(kFirst * VoxelFile::kChunkVoxels + i, side, colours)) << side << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace arris::tiling
