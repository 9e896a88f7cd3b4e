#include "tiling/voxel_file.h"

#include <algorithm>
#include <utility>

#include "tiling/checked_file.h"

namespace arris::tiling {
namespace {

constexpr std::uint64_t kChunkBytes = VoxelFile::kChunkVoxels * sizeof(Voxel);

std::uint64_t checksum(Hasher& hasher, std::span<const Voxel> voxels) {
  hasher.reset();
  hasher.update(voxels.data(), voxels.size_bytes());
  return hasher.digest();
}

std::span<const Voxel> chunk_at(std::span<const Voxel> voxels, std::size_t at) {
  return voxels.subspan(at, std::min(VoxelFile::kChunkVoxels, voxels.size() - at));
}

}  // namespace

VoxelFile::VoxelFile(std::filesystem::path path, std::size_t buffer_bytes)
    : file_(std::move(path)), buffer_voxels_(std::max<std::size_t>(buffer_bytes / kChunkBytes, 1) * kChunkVoxels) {
  buffer_.reserve(buffer_voxels_);
}

void VoxelFile::flush() {
  Hasher hasher;
  for (std::size_t at = 0; at < buffer_.size(); at += kChunkVoxels) {
    checksums_.push_back(checksum(hasher, chunk_at(std::span<const Voxel>(buffer_), at)));
  }
  file_.append(std::as_bytes(std::span(buffer_)));
  buffer_.clear();
}

void VoxelFile::finish() {
  flush();
  std::vector<Voxel>().swap(buffer_);  // Assigning {} would keep the memory.
  checksums_.shrink_to_fit();
}

void VoxelFile::read(std::size_t first, std::size_t count, std::vector<Voxel>& voxels) const {
  const std::uint64_t begin = first * kChunkBytes;
  const std::uint64_t end = std::min((first + count) * kChunkBytes, file_.size_bytes());
  const std::size_t before = voxels.size();
  voxels.resize(before + (end - begin) / sizeof(Voxel));
  const std::span<Voxel> read = std::span(voxels).subspan(before);
  file_.read_at(begin, std::as_writable_bytes(read));
  Hasher hasher;
  for (std::size_t chunk = 0; chunk < count; ++chunk) {
    if (checksum(hasher, chunk_at(read, chunk * kChunkVoxels)) != checksums_[first + chunk]) file_.throw_damaged();
  }
}

}  // namespace arris::tiling
