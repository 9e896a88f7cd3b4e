#pragma once
/// @file All voxels of a scan: one checked file in Z-order, and an index in memory.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "core/lattice.h"
#include "core/voxel.h"

namespace arris::tiling {

/// Which voxels exist, and the rank of each in Z-order (morton.h). Blocks of 8x8x8 voxels with a bit per voxel: about
/// 100 bytes per block, 1.5 to 3 bytes per voxel of a surface. Immutable once filled; reading is thread-safe.
class VoxelIndex {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  /// Keys in strictly ascending Z-order.
  void append(const LatticePoint& key);
  /// Call after the last append().
  void finish();

  std::uint32_t size() const { return size_; }
  /// Rank of the voxel, kNone if it does not exist. O(1); fast for neighbours of the voxel asked for last if `hint`
  /// (any value at first, kept by the caller, one per thread) is passed.
  std::uint32_t rank(const LatticePoint& key, std::uint32_t& hint) const;
  std::uint32_t rank(const LatticePoint& key) const {
    std::uint32_t hint = 0;
    return rank(key, hint);
  }
  /// Of the keys, half-open; empty if there are none.
  const LatticeBox& bounds() const { return bounds_; }
  std::uint64_t memory_bytes() const;

  struct Block {
    LatticePoint key;          ///< Voxel keys >> 3.
    std::uint32_t first_rank;  ///< Ranks of a block are consecutive.
    std::uint32_t voxels;
  };
  std::size_t blocks() const;
  Block block(std::size_t i) const;  ///< In Z-order.

 private:
  // The developer's choice: a mask of 8 words per block with running popcounts, and an open-addressing directory.
  std::uint32_t size_ = 0;
  LatticeBox bounds_;
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
  std::uint64_t bytes_on_disk() const;

 private:
  friend class VoxelAccumulator;
  struct Impl;
  explicit VoxelStore(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace arris::tiling
