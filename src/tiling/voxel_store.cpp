#include "tiling/voxel_store.h"

#include <algorithm>
#include <cstddef>

#include "tiling/voxel_selection.h"
#include "tiling/voxel_store_parts.h"

namespace arris::tiling {
namespace {

/// Read at a time.
constexpr std::uint32_t kStretch = 8 * VoxelFile::kChunkVoxels;

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

void VoxelStore::read(std::uint32_t begin, std::uint32_t end, std::vector<Voxel>& voxels) const {
  constexpr auto kChunk = static_cast<std::uint32_t>(VoxelFile::kChunkVoxels);
  voxels.clear();
  if (begin == end) return;
  const std::uint32_t first = begin / kChunk * kChunk;  // Only whole chunks can be verified.
  const std::uint32_t last = std::min((end - 1) / kChunk * kChunk, size() - 1) + kChunk;
  voxels.resize(std::min(last, size()) - first);
  impl_->file.read(first / kChunk, voxels);
  voxels.resize(end - first);
  voxels.erase(voxels.begin(), voxels.begin() + (begin - first));
  auto voxel = voxels.begin();
  impl_->index.for_each_key(begin, end, [&](const LatticePoint& key) { (voxel++)->key = key; });
}

std::vector<RankRange> VoxelStore::stretches(const LatticeBox& keys) const {
  std::vector<RankRange> found;
  for (const BlockRange& blocks : select_blocks(impl_->index, keys)) {
    const std::uint32_t end = impl_->index.first_rank(blocks.end);
    for (std::uint32_t rank = impl_->index.first_rank(blocks.begin); rank < end; rank = found.back().end) {
      found.push_back({rank, rank + std::min(kStretch - rank % kStretch, end - rank)});
    }
  }
  return found;
}

void VoxelStore::load(const LatticeBox& keys, std::vector<Voxel>& voxels, std::vector<std::uint32_t>& ranks) const {
  voxels.clear();
  ranks.clear();
  std::vector<Voxel> stretch;
  for (const RankRange& range : stretches(keys)) {
    read(range.begin, range.end, stretch);
    for (std::size_t i = 0; i < stretch.size(); ++i) {
      if (!keys.contains(stretch[i].key)) continue;
      voxels.push_back(stretch[i]);
      ranks.push_back(range.begin + static_cast<std::uint32_t>(i));
    }
  }
}

}  // namespace arris::tiling
