#pragma once
/// @file The voxels of a scan in a file.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "core/voxel.h"
#include "tiling/scratch_file.h"

namespace arris::tiling {

/// What a voxel takes in a file that says by rank where it is: its key is known from there.
class VoxelLayout {
 public:
  VoxelLayout(const VoxelGrid& grid, bool colours)
      : wide_(std::int64_t{grid.side_steps()} * kVoxelFractions > (1 << 16)), colours_(colours) {}
  std::size_t bytes() const { return (wide_ ? 12 : 6) + (colours_ ? 6 : 0); }
  /// All but the key.
  void write(const Voxel& voxel, std::byte* to) const;
  void read(const std::byte* from, Voxel& voxel) const;

 private:
  bool wide_;  ///< Fractions of a voxel's side do not fit 16 bits.
  bool colours_;
};

/// Voxels by rank, without their keys, in chunks of kChunkVoxels whose checksums (XXH3) stay in memory: 8 bytes per
/// chunk. Removes its file on destruction. read() is thread-safe. Throws IoError.
class VoxelFile {
 public:
  static constexpr std::size_t kChunkVoxels = 1024;

  /// @param buffer_bytes  for writing; rounded to whole chunks, at least one.
  VoxelFile(std::filesystem::path path, std::size_t buffer_bytes, const VoxelLayout& layout);
  void append(std::span<const Voxel> voxels);
  /// Call after the last append().
  void finish();

  std::uint64_t size_bytes() const { return file_.size_bytes(); }
  /// Fills all but the keys of the voxels, which begin with a chunk and end with one or with the file. Verified.
  void read(std::size_t first_chunk, std::span<Voxel> voxels) const;

 private:
  void flush();
  std::size_t chunk_bytes() const { return kChunkVoxels * layout_.bytes(); }

  ScratchFile file_;
  VoxelLayout layout_;
  std::size_t buffer_bytes_;
  std::vector<std::byte> buffer_;
  std::vector<std::uint64_t> checksums_;
};

}  // namespace arris::tiling
