#include "tiling/voxel_store.h"

#include <algorithm>
#include <cstddef>

#include "tiling/voxel_selection.h"
#include "tiling/voxel_store_parts.h"

namespace arris::tiling {
namespace {

constexpr std::size_t kReadChunks = 16;

struct ChunkRange {
  std::size_t begin;
  std::size_t end;
};

/// Chunks that hold the ranks, each once.
std::vector<ChunkRange> chunks_of(const std::vector<RankRange>& ranks) {
  std::vector<ChunkRange> chunks;
  for (const RankRange& range : ranks) {
    const std::size_t begin = range.begin / VoxelFile::kChunkVoxels;
    const std::size_t end = (std::size_t{range.end} - 1) / VoxelFile::kChunkVoxels + 1;
    if (!chunks.empty() && chunks.back().end >= begin) {
      chunks.back().end = end;
    } else {
      chunks.push_back({begin, end});
    }
  }
  return chunks;
}

}  // namespace

VoxelStore::VoxelStore(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
VoxelStore::~VoxelStore() = default;
VoxelStore::VoxelStore(VoxelStore&&) noexcept = default;
VoxelStore& VoxelStore::operator=(VoxelStore&&) noexcept = default;

const VoxelIndex& VoxelStore::index() const {
  return impl_->index;
}
const VoxelGrid& VoxelStore::grid() const {
  return impl_->grid;
}
std::uint16_t VoxelStore::largest_colour() const {
  return impl_->largest_colour;
}
std::uint64_t VoxelStore::points() const {
  return impl_->points;
}
std::uint64_t VoxelStore::bytes_on_disk() const {
  return impl_->file.size_bytes();
}

void VoxelStore::for_each_stretch(
    const LatticeBox& keys, const std::function<void(std::span<const Voxel>, std::uint32_t first_rank)>& use) const {
  std::vector<Voxel> read;
  for (const ChunkRange& range : chunks_of(select_ranks(impl_->index, keys))) {
    for (std::size_t chunk = range.begin; chunk < range.end; chunk += kReadChunks) {
      read.clear();
      impl_->file.read(chunk, std::min(kReadChunks, range.end - chunk), read);
      use(read, static_cast<std::uint32_t>(chunk * VoxelFile::kChunkVoxels));
    }
  }
}

std::size_t VoxelStore::most_voxels(const LatticeBox& keys) const {
  std::size_t most = 0;
  for (const RankRange& range : select_ranks(impl_->index, keys)) most += range.end - range.begin;
  return most;
}

void VoxelStore::load(const LatticeBox& keys, std::vector<Voxel>& voxels, std::vector<std::uint32_t>& ranks) const {
  voxels.clear();
  ranks.clear();
  const std::size_t most = most_voxels(keys);
  voxels.reserve(most);
  ranks.reserve(most);
  for_each_stretch(keys, [&](std::span<const Voxel> stretch, std::uint32_t rank) {
    for (const Voxel& voxel : stretch) {
      if (keys.contains(voxel.key)) {
        voxels.push_back(voxel);
        ranks.push_back(rank);
      }
      ++rank;
    }
  });
}

}  // namespace arris::tiling
