#pragma once
/// @file Sums of voxels become the voxels of a store.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/parallel.h"
#include "tiling/voxel_store_parts.h"
#include "tiling/voxel_sums.h"
#include "tiling/voxel_table.h"

namespace arris::tiling {

/// Records in, voxels out. Voxels are put into file and index on another thread while the next ones are summed, unless
/// loops may use one thread only. Throws IoError; BudgetError if there are 2^32 - 1 or more voxels, or if their index
/// becomes too large. Not thread-safe.
class VoxelStoreFiller {
 public:
  /// Memory is taken for so many.
  static constexpr std::size_t kVoxelsOnTheirWay = std::size_t{8} * 1024;

  /// Both must outlive it.
  VoxelStoreFiller(VoxelFile& file, VoxelIndex& index, std::uint64_t most_index_bytes);

  /// Those of one voxel one after another, voxels in Z-order.
  void add(const VoxelRecord& record);
  /// All there are, summed by all threads.
  void add_sorted(const VoxelTable::Sorted& records);
  /// Call it once all records are there.
  void finish();

 private:
  static constexpr std::size_t kPart = 512;
  static constexpr std::size_t kParts = kVoxelsOnTheirWay / 2 / kPart;
  using Parts = std::array<std::vector<Voxel>, kParts>;

  void complete();
  void fill();
  void append_taken();

  VoxelFile& file_;
  VoxelIndex& index_;
  std::uint64_t most_index_bytes_;
  std::optional<VoxelTotal> total_;
  Parts summed_, taken_;
  std::optional<BackgroundTasks> filling_;  // Of what is taken. Joined before that goes.
};

}  // namespace arris::tiling
