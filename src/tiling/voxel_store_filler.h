#pragma once
/// @file Sums of voxels become the voxels of a store.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/stages.h"
#include "core/voxel.h"
#include "tiling/voxel_store_parts.h"
#include "tiling/voxel_sums.h"
#include "tiling/voxel_table.h"

namespace arris::tiling {

/// Records in, voxels out. Voxels are put into file and index, in turn, while others are summed, on as many threads as
/// loops may use. Throws IoError; BudgetError if there are 2^32 - 1 or more voxels, or if their index becomes too
/// large. Not thread-safe.
class VoxelStoreFiller {
 public:
  /// Records of a table at a time.
  static constexpr std::size_t kPart = 1536;
  /// Others, which have to be copied.
  static constexpr std::size_t kRecords = 768;
  /// For those on their way.
  static constexpr std::size_t kPlaces = 4;
  /// Of records and voxels on their way; little more where voxels have several records.
  static constexpr std::size_t kMemoryBytes =
      kPlaces * std::max(kPart * sizeof(Voxel), kRecords*(sizeof(VoxelRecord) + sizeof(Voxel)));

  /// Both must outlive it.
  VoxelStoreFiller(VoxelFile& file, VoxelIndex& index, std::uint64_t most_index_bytes);

  /// What fill() gives until it returns false: all records of some voxels each time, kRecords or a few more, those of
  /// one voxel one after another, voxels in Z-order. It is called by one thread at a time, on any.
  void add_all(const std::function<bool(std::vector<VoxelRecord>& records)>& fill);
  /// All there are, summed by all threads.
  void add_all(const VoxelTable::Sorted& records);

 private:
  void add_to_index(const std::vector<Voxel>& voxels);

  VoxelFile& file_;
  VoxelIndex& index_;
  std::uint64_t most_index_bytes_;
};

}  // namespace arris::tiling
