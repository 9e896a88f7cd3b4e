#pragma once
/// @file Merges sorted runs of sums of voxels.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tiling/voxel_run.h"

namespace arris::tiling {

/// All records of some runs in Z-order of voxels, those of one voxel one after another. A heap of runs: O(1) per record
/// while they come from the same run, O(log runs) else. Memory: buffer_bytes per run.
class VoxelMerge {
 public:
  /// The runs must outlive the merge.
  VoxelMerge(std::span<const std::unique_ptr<VoxelRun>> runs, std::size_t buffer_bytes);
  /// False at the end, when all runs are verified.
  bool next(VoxelRecord& record);

 private:
  struct Head {
    LatticePoint key;
    std::uint32_t run;
  };
  void sift_down(std::size_t at);

  std::vector<VoxelRun*> runs_;
  std::vector<VoxelRecord> records_;  // Next of each run.
  std::vector<Head> heap_;            // Smallest first.
};

}  // namespace arris::tiling
