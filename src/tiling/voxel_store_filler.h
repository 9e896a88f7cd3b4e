#pragma once
/// @file Sums of voxels become the voxels of a store.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/stages.h"
#include "tiling/voxel_store_parts.h"
#include "tiling/voxel_sums.h"
#include "tiling/voxel_table.h"

namespace arris::tiling {

/// Records in, voxels out. Voxels are put into file and index, in turn, while others are summed, on as many threads as
/// loops may use. Throws IoError; BudgetError if there are 2^32 - 1 or more voxels, or if their index becomes too
/// large. Not thread-safe.
class VoxelStoreFiller {
 public:
  static constexpr std::size_t kPart = 2048;
  /// Memory is taken for so many.
  static constexpr std::size_t kVoxelsOnTheirWay = kItemsAhead * kPart;

  /// Both must outlive it.
  VoxelStoreFiller(VoxelFile& file, VoxelIndex& index, std::uint64_t most_index_bytes);

  /// What next() gives until it returns false: the records of one voxel one after another, voxels in Z-order.
  void add_all(const std::function<bool(VoxelRecord& record)>& next);
  /// All there are, summed by all threads.
  void add_all(const VoxelTable::Sorted& records);

 private:
  void append(const std::vector<Voxel>& voxels);

  VoxelFile& file_;
  VoxelIndex& index_;
  std::uint64_t most_index_bytes_;
};

}  // namespace arris::tiling
