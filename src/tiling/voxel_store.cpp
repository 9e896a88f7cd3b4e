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

void VoxelStore::for_each_stretch(
    const LatticeBox& keys, const std::function<void(std::span<const Voxel>, std::uint32_t first_rank)>& use) const {
  std::vector<Voxel> voxels;
  for (const BlockRange& blocks : select_blocks(impl_->index, keys)) {
    const std::uint32_t end = impl_->index.first_rank(blocks.end);
    for (std::uint32_t rank = impl_->index.first_rank(blocks.begin); rank < end;) {
      const std::uint32_t next = rank + std::min(kStretch - rank % kStretch, end - rank);
      read(rank, next, voxels);
      use(voxels, rank);
      rank = next;
    }
  }
}

void VoxelStore::load(const LatticeBox& keys, std::vector<Voxel>& voxels, std::vector<std::uint32_t>& ranks) const {
  voxels.clear();
  ranks.clear();
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
