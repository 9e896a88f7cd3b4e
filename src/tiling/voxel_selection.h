#pragma once
/// @file Finds the blocks of voxels that meet a box.

#include <cstdint>
#include <vector>

#include "core/lattice.h"
#include "tiling/voxel_index.h"

namespace arris::tiling {

struct RankRange {
  std::uint32_t begin;
  std::uint32_t end;
  friend bool operator==(const RankRange&, const RankRange&) = default;
};

/// Ranks of all voxels of the blocks that may hold voxels of the box: ascending ranges with gaps between them. Skips
/// what is outside by halving cubes: O(ranges log(blocks)).
std::vector<RankRange> select_ranks(const VoxelIndex& index, const LatticeBox& keys);

}  // namespace arris::tiling
