#include "pipeline/voxel_labels.h"

#include <algorithm>
#include <array>

#include "core/prefetch.h"

namespace arris::pipeline {

void VoxelLabels::find(std::span<const LatticePoint> points, std::span<std::uint32_t> ids) {
  constexpr std::size_t kAtATime = 512;
  std::array<LatticePoint, kAtATime> keys;
  std::array<std::uint32_t, kAtATime> ranks;
  for (std::size_t begin = 0; begin < points.size(); begin += kAtATime) {
    const std::size_t count = std::min(kAtATime, points.size() - begin);
    for (std::size_t i = 0; i < count; ++i) keys[i] = store_.grid().voxel_of(points[begin + i]);
    store_.index().ranks(std::span(keys).first(count), std::span(ranks).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      if (ranks[i] != tiling::VoxelIndex::kNone) prefetch(&clusters_.ids[ranks[i]]);
    }
    for (std::size_t i = 0; i < count; ++i) ids[begin + i] = id_at(points[begin + i], keys[i], ranks[i]);
  }
}

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
