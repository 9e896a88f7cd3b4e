#pragma once
/// @file The supervoxel of any lattice position.

#include <cstdint>
#include <span>

#include "core/lattice.h"
#include "tiling/voxel_store.h"

namespace arris::pipeline {

/// Both must outlive it. Thread-safe.
class VoxelLabels {
 public:
  VoxelLabels(const tiling::VoxelStore& store, std::span<const std::uint32_t> ids) : store_(store), ids_(ids) {}

  /// 0 where there is no voxel. @param hint  see VoxelIndex::rank.
  std::uint32_t at(const LatticePoint& p, std::uint32_t& hint) const {
    const std::uint32_t rank = store_.index().rank(store_.grid().voxel_of(p), hint);
    return rank == tiling::VoxelIndex::kNone ? 0 : ids_[rank];
  }

 private:
  const tiling::VoxelStore& store_;
  std::span<const std::uint32_t> ids_;
};

}  // namespace arris::pipeline
