#include "pipeline/voxel_labels.h"

#include <algorithm>

namespace arris::pipeline {

std::uint32_t VoxelLabels::refine(const LatticePoint& p, const LatticePoint& key, std::uint32_t rank,
                                  std::uint32_t own) {
  if (rank != last_rank_) {
    last_rank_ = rank;
    around_.clear();
    std::array<std::uint32_t, 27> ranks;
    store_.index().ranks_around(key, hint_, ranks);
    for (const std::uint32_t neighbour : ranks) {
      if (neighbour == tiling::VoxelIndex::kNone) continue;
      const std::uint32_t id = clusters_.ids[neighbour];
      if (id != own && std::find(around_.begin(), around_.end(), id) == around_.end()) around_.push_back(id);
    }
  }
  VoxelPosition at;
  for (int axis = 0; axis < 3; ++axis)
    at[static_cast<std::size_t>(axis)] = kVoxelFractions * static_cast<std::uint32_t>(p[axis]);
  return refined_label(clusters_.planes, own, around_, at, store_.grid().side_steps());
}

}  // namespace arris::pipeline
