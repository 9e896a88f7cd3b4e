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

/// Voxels by rank, in chunks of kChunkVoxels whose checksums (XXH3) stay in memory: 8 bytes per chunk. Removes its file
/// on destruction. read() is thread-safe. Throws IoError.
class VoxelFile {
 public:
  static constexpr std::size_t kChunkVoxels = 1024;

  /// @param buffer_bytes  for writing; rounded to whole chunks, at least one.
  VoxelFile(std::filesystem::path path, std::size_t buffer_bytes);
  void append(const Voxel& voxel) {
    if (buffer_.size() == buffer_voxels_) flush();
    buffer_.push_back(voxel);
  }
  /// Call after the last append().
  void finish();

  std::size_t chunks() const { return checksums_.size(); }
  std::uint64_t size_bytes() const { return file_.size_bytes(); }
  /// Appends the voxels of `count` chunks from `first` on to `voxels`, verified.
  void read(std::size_t first, std::size_t count, std::vector<Voxel>& voxels) const;

 private:
  void flush();

  ScratchFile file_;
  std::size_t buffer_voxels_;
  std::vector<Voxel> buffer_;
  std::vector<std::uint64_t> checksums_;
};

}  // namespace arris::tiling
