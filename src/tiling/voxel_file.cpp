#include "tiling/voxel_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "tiling/checked_file.h"

namespace arris::tiling {

void VoxelLayout::write(const Voxel& voxel, std::byte* to) const {
  if (wide_) {
    std::memcpy(to, voxel.centroid.data(), sizeof(voxel.centroid));
    to += sizeof(voxel.centroid);
  } else {
    std::array<std::uint16_t, 3> centroid;
    for (std::size_t axis = 0; axis < 3; ++axis) centroid[axis] = static_cast<std::uint16_t>(voxel.centroid[axis]);
    std::memcpy(to, centroid.data(), sizeof(centroid));
    to += sizeof(centroid);
  }
  if (colours_) std::memcpy(to, voxel.colour.data(), sizeof(voxel.colour));
}

void VoxelLayout::read(const std::byte* from, Voxel& voxel) const {
  if (wide_) {
    std::memcpy(voxel.centroid.data(), from, sizeof(voxel.centroid));
    from += sizeof(voxel.centroid);
  } else {
    std::array<std::uint16_t, 3> centroid;
    std::memcpy(centroid.data(), from, sizeof(centroid));
    std::ranges::copy(centroid, voxel.centroid.begin());
    from += sizeof(centroid);
  }
  if (colours_) {
    std::memcpy(voxel.colour.data(), from, sizeof(voxel.colour));
  } else {
    voxel.colour = {};
  }
}

VoxelFile::VoxelFile(std::filesystem::path path, std::size_t buffer_bytes, const VoxelLayout& layout)
    : file_(std::move(path)),
      layout_(layout),
      buffer_bytes_(std::max<std::size_t>(buffer_bytes / chunk_bytes(), 1) * chunk_bytes()) {
  buffer_.reserve(buffer_bytes_);
}

void VoxelFile::append(std::span<const Voxel> voxels) {
  while (!voxels.empty()) {
    if (buffer_.size() == buffer_bytes_) flush();
    const std::size_t count = std::min(voxels.size(), (buffer_bytes_ - buffer_.size()) / layout_.bytes());
    const std::size_t at = buffer_.size();
    buffer_.resize(at + count * layout_.bytes());
    for (std::size_t i = 0; i < count; ++i) layout_.write(voxels[i], buffer_.data() + at + i * layout_.bytes());
    voxels = voxels.subspan(count);
  }
}

void VoxelFile::flush() {
  Hasher hasher;
  for (std::size_t at = 0; at < buffer_.size(); at += chunk_bytes()) {
    hasher.reset();
    hasher.update(buffer_.data() + at, std::min(chunk_bytes(), buffer_.size() - at));
    checksums_.push_back(hasher.digest());
  }
  file_.append(buffer_);
  buffer_.clear();
}

void VoxelFile::finish() {
  flush();
  std::vector<std::byte>().swap(buffer_);  // Assigning {} would keep the memory.
  checksums_.shrink_to_fit();
}

void VoxelFile::read(std::size_t first_chunk, std::span<Voxel> voxels) const {
  std::vector<std::byte> bytes(voxels.size() * layout_.bytes());
  file_.read_at(first_chunk * chunk_bytes(), bytes);
  Hasher hasher;
  for (std::size_t at = 0, chunk = first_chunk; at < bytes.size(); at += chunk_bytes(), ++chunk) {
    hasher.reset();
    hasher.update(bytes.data() + at, std::min(chunk_bytes(), bytes.size() - at));
    if (hasher.digest() != checksums_[chunk]) file_.throw_damaged();
  }
  for (std::size_t i = 0; i < voxels.size(); ++i) layout_.read(bytes.data() + i * layout_.bytes(), voxels[i]);
}

}  // namespace arris::tiling
