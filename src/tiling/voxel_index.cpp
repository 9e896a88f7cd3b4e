#include "tiling/voxel_index.h"

#include <algorithm>

#include "tiling/voxel_hash.h"

namespace arris::tiling {
namespace {

constexpr std::size_t kSlotsPerBlock = 2;

}  // namespace

void VoxelIndex::append(const LatticePoint& key) {
  const LatticePoint block{key.x >> kLog2, key.y >> kLog2, key.z >> kLog2};
  if (blocks_.size() == 0 || !(blocks_.back().key == block)) {
    if (size_ == 0) least_ = most_ = key;
    blocks_.push_back({block, size_, 0, static_cast<std::uint32_t>(words_.size()), 0});
  }
  Entry& entry = blocks_.back();
  const std::uint32_t place = place_in_block(key);
  const std::uint32_t part = place >> 6;
  if ((entry.parts >> (24 + part) & 1) == 0) {
    // Parts come in order: all that was before, of words and voxels, is known.
    if (part > 0) {
      entry.parts |= (static_cast<std::uint32_t>(words_.size()) - entry.first_word) << 3 * (part - 1);
      entry.before |= std::uint64_t{size_ - entry.first_rank} << 9 * (part - 1);
    }
    entry.parts |= 1U << (24 + part);
    words_.push_back(0);
  }
  words_.back() |= std::uint64_t{1} << (place & 63);
  least_ = {std::min(least_.x, key.x), std::min(least_.y, key.y), std::min(least_.z, key.z)};
  most_ = {std::max(most_.x, key.x), std::max(most_.y, key.y), std::max(most_.z, key.z)};
  ++size_;
}

void VoxelIndex::finish() {
  if (size_ == 0) return;
  bounds_.include(least_);
  bounds_.include(most_);
  blocks_.shrink_to_fit();
  words_.shrink_to_fit();
  slots_ = HashSlots(blocks_.size() * kSlotsPerBlock, blocks_.size());
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const std::uint32_t hash = voxel_hash(blocks_[i].key);
    slots_.set(slots_.find(hash, [](std::uint32_t) { return false; }), hash, static_cast<std::uint32_t>(i));
  }
}

std::uint32_t VoxelIndex::find_block(const LatticePoint& block) const {
  if (size_ == 0) return kNone;
  return slots_.at(slots_.find(voxel_hash(block), [&](std::uint32_t i) { return blocks_[i].key == block; }));
}

VoxelIndex::Block VoxelIndex::block(std::size_t i) const {
  const Entry& entry = blocks_[i];
  const std::uint32_t end = i + 1 < blocks_.size() ? blocks_[i + 1].first_rank : size_;
  return {entry.key, entry.first_rank, end - entry.first_rank};
}

}  // namespace arris::tiling
