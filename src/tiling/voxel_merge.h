#pragma once
/// @file Merges sorted runs of sums of voxels.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tiling/page_array.h"
#include "tiling/voxel_run.h"

namespace arris::tiling {

/// All records of some runs in Z-order of voxels, those of one voxel one after another. A heap of runs: one comparison
/// per record while they come from the same run, O(log runs) else. Memory: buffer_bytes per run.
class VoxelMerge {
 public:
  /// The runs must outlive the merge.
  VoxelMerge(std::span<const std::unique_ptr<VoxelRun>> runs, std::size_t buffer_bytes);
  /// False at the end, when all runs are verified.
  bool next(VoxelRecord& record) {
    if (heap_.empty()) return false;
    advance(record);
    return true;
  }
  /// The next records, all those of some voxels: `least` or more, unless there are no more. False: none were left.
  bool next(std::vector<VoxelRecord>& records, std::size_t least);

 private:
  struct Head {
    LatticePoint key;
    std::uint32_t run;
  };
  void advance(VoxelRecord& record);
  void sift_down(std::size_t at);
  void find_second();

  PageArray<std::byte> buffers_;
  std::vector<VoxelRun*> runs_;
  std::vector<VoxelRecord> records_;  // Next of each run.
  std::vector<Head> heap_;            // Smallest first.
  std::size_t second_ = 0;            // The smallest but one.
};

}  // namespace arris::tiling
