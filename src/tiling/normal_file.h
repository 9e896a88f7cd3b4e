#pragma once
/// @file Normals of voxels on disk, between passes over tiles.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "core/pages.h"
#include "core/voxel_tile.h"
#include "tiling/scratch_file.h"

namespace arris::tiling {

/// Written tile by tile, read by rank. 12 bytes per voxel on disk; in memory 24 bytes per chunk, which is a stretch of
/// consecutive ranks, at most kChunkVoxels of them, and has a checksum (XXH3). Removes its file on destruction.
/// Throws IoError.
class NormalFile {
 public:
  using Normal = std::array<float, 3>;
  static constexpr std::size_t kChunkVoxels = 4096;

  explicit NormalFile(std::filesystem::path path) : file_(std::move(path)) {}

  /// Those of the core of a tile; cores are disjoint.
  void append(const VoxelTile& tile, std::span<const Normal> normals);
  /// Call after the last append().
  void finish();
  /// Of all voxels of a tile, which must lie in the cores that were appended. Verified.
  /// Reads in parallel.
  PageVector<Normal> read(const VoxelTile& tile) const;

  std::uint64_t size_bytes() const { return file_.size_bytes(); }

 private:
  struct Chunk {
    std::uint32_t first_rank;
    std::uint32_t voxels;
    std::uint64_t offset;
    std::uint64_t checksum;
  };
  /// Makes the normals from `begin` on a chunk that ends before `end_rank`.
  void add_chunk(std::span<const Normal> normals, std::size_t begin, std::uint32_t end_rank);

  ScratchFile file_;
  std::vector<Chunk> chunks_;
};

}  // namespace arris::tiling
