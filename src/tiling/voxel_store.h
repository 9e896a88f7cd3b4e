#pragma once
/// @file All voxels of a scan: one checked file in Z-order, and an index in memory.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "core/voxel.h"
#include "tiling/voxel_index.h"

namespace arris::tiling {

/// Ranks [begin, end).
struct RankRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

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
  /// Short stretches of consecutive ranks, ascending, that together hold all voxels of the box, and others; cut where
  /// parts of the file end.
  std::vector<RankRange> stretches(const LatticeBox& keys) const;
  /// Replaces `voxels` by those with ranks [begin, end). Verified. Thread-safe. Throws IoError likewise.
  void read(std::uint32_t begin, std::uint32_t end, std::vector<Voxel>& voxels) const;
  std::uint64_t bytes_on_disk() const;

 private:
  friend class VoxelAccumulator;
  struct Impl;
  explicit VoxelStore(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace arris::tiling
