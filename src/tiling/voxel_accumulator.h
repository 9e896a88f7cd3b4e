#pragma once
/// @file Reduces a stream of points of any length to voxels, in bounded memory.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>

#include "core/voxel.h"
#include "tiling/voxel_store.h"
#include "tiling/voxel_stream.h"

namespace arris::tiling {

/// Sums points per voxel in a hash table. When the table is full it is written out as a run, sorted in Z-order of
/// voxels; finish() merges the runs. Sums are integers, so the voxels depend on the set of points only, not on their
/// order, the size of the table or the number of runs.
///
/// Memory: table_bytes, during add() as during finish(), and the index of the store. 52 bytes per voxel in the table,
/// 64 with colours. Temporary disk: 28 bytes (40 with colours) per entry of a run, twice that while many runs are
/// merged in rounds, and 6 (12 with colours; 6 more where voxels have more
/// than 4096 steps) per voxel of the store; a run has as many entries as there are voxels when neighbours in
/// the input are neighbours in space, as many as points at worst. One accumulator per folder at a time. Not
/// thread-safe.
class VoxelAccumulator {
 public:
  struct Options {
    std::filesystem::path folder;                        ///< Existing; runs and the store go here.
    std::size_t table_bytes = 32U * 1024U * 1024U;       ///< >= 1 MiB; less works, but takes more than was said.
    std::uint64_t most_index_bytes = ~std::uint64_t{0};  ///< finish() throws BudgetError rather than exceed it.
    std::size_t likely_voxels = 0;                       ///< About so many; 0: not known. The table need not grow then.
  };
  VoxelAccumulator(const VoxelGrid& grid, Options options);
  ~VoxelAccumulator();
  VoxelAccumulator(const VoxelAccumulator&) = delete;
  VoxelAccumulator& operator=(const VoxelAccumulator&) = delete;

  /// @param colours  as many as positions, or none.
  void add(std::span<const LatticePoint> positions, std::span<const RawColour> colours = {});
  /// The same with all batches that fill() gives, until it returns false, side by side with fill(), which is called by
  /// one thread at a time, on any. Either all of them have colours or none.
  void add_all(const std::function<bool(VoxelPoints& points)>& fill);
  /// Completes the voxels; call once, then add() no more. Throws IoError; BudgetError if there are 2^32 - 1 or more
  /// voxels, or if their index becomes too large.
  VoxelStore finish();
  std::uint64_t bytes_on_disk() const;  ///< Of runs and store, at most so far.

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace arris::tiling
