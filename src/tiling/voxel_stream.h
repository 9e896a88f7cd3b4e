#pragma once
/// @file Adds batch after batch to a table of voxels, all lanes side by side.

#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/lattice.h"
#include "core/voxel.h"
#include "tiling/voxel_table.h"

namespace arris::tiling {

struct VoxelPoints {
  std::vector<LatticePoint> positions;
  std::vector<RawColour> colours;  ///< As many, or none.
};

/// Points are dealt out to the lanes, and each lane goes through the batches at its own speed, while others are filled.
/// Either all batches have colours or none, and the table knows them before (VoxelTable::start_colours). Memory: four
/// batches more than the table has lanes, and 4 bytes per point of them. Both arguments must outlive it; fill() is
/// called by one thread at a time, on any.
class VoxelStream {
 public:
  VoxelStream(VoxelTable& table, const std::function<bool(VoxelPoints&)>& fill);

  /// True: everything that fill() had has been added, until it returned false. False: the table is full; take its sums
  /// and call it again. Throws what fill() throws.
  bool run();

 private:
  struct Batch {
    VoxelPoints points;
    VoxelTable::Dealt dealt;
  };
  void add(Batch& batch, std::size_t lane);
  bool add_rest();

  VoxelTable& table_;
  const std::function<bool(VoxelPoints&)>& fill_;
  std::vector<Batch> batches_;
  std::atomic<bool> full_{false};
  bool ended_ = false;
};

}  // namespace arris::tiling
