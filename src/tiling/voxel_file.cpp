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

}  // namespace

VoxelFile::VoxelFile(std::filesystem::path path) : file_(std::move(path)) {
  buffer_.reserve(kChunkVoxels);
}

void VoxelFile::flush() {
  if (buffer_.empty()) return;
  Hasher hasher;
  checksums_.push_back(checksum(hasher, buffer_));
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
    const std::size_t at = chunk * kChunkVoxels;
    const auto part = read.subspan(at, std::min(kChunkVoxels, read.size() - at));
    if (checksum(hasher, part) != checksums_[first + chunk]) file_.throw_damaged();
  }
}

}  // namespace arris::tiling
