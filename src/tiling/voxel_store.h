#pragma once
/// @file All voxels of a scan: one checked file in Z-order, and an index in memory.

#include <cstdint>
#include <memory>
#include <vector>

#include "core/lattice.h"
#include "core/voxel.h"
#include "tiling/voxel_index.h"

namespace arris::tiling {

/// The voxels of a VoxelAccumulator. Movable. Removes its file on destruction.
class VoxelStore {
 public:
  ~VoxelStore();
  VoxelStore(VoxelStore&&) noexcept;
  VoxelStore& operator=(VoxelStore&&) noexcept;

  std::uint32_t size() const { return index().size(); }
  const VoxelIndex& index() const;
  const VoxelGrid& grid() const;
  /// Largest raw colour channel of any point (not of the means); 0 without colours.
  std::uint16_t largest_colour() const;
  /// Points in all voxels.
  std::uint64_t points() const;
  /// Replaces the outputs by the voxels whose keys lie in `keys`, in Z-order, and their ranks. Reads whole blocks, each
  /// part of the file verified by its checksum. Thread-safe. Throws IoError if the bytes are not those written.
  void load(const LatticeBox& keys, std::vector<Voxel>& voxels, std::vector<std::uint32_t>& ranks) const;
  std::uint64_t bytes_on_disk() const;

 private:
  friend class VoxelAccumulator;
  struct Impl;
  explicit VoxelStore(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace arris::tiling
