#include "tiling/voxel_index.h"

#include <algorithm>
#include <bit>

#include "tiling/voxel_hash.h"

namespace arris::tiling {
namespace {

constexpr std::size_t kSlotsPerEightBlocks = 13;

std::uint32_t index_mask(int index_bits) {
  return static_cast<std::uint32_t>((std::uint64_t{1} << index_bits) - 1);
}
std::uint32_t tag_of(std::uint32_t hash, int index_bits) {
  return static_cast<std::uint32_t>(std::uint64_t{hash} << index_bits);
}

}  // namespace

void VoxelIndex::append(const LatticePoint& key) {
  const LatticePoint block{key.x >> kLog2, key.y >> kLog2, key.z >> kLog2};
  if (blocks_.size() == 0 || !(blocks_.back().key == block)) {
    if (size_ == 0) least_ = most_ = key;
    blocks_.push_back({block, size_, {}, {}});
  }
  const std::uint32_t place = place_in_block(key);
  blocks_.back().words[place >> 6] |= std::uint64_t{1} << (place & 63);
  least_ = {std::min(least_.x, key.x), std::min(least_.y, key.y), std::min(least_.z, key.z)};
  most_ = {std::max(most_.x, key.x), std::max(most_.y, key.y), std::max(most_.z, key.z)};
  ++size_;
}

void VoxelIndex::finish() {
  if (size_ == 0) return;
  bounds_.include(least_);
  bounds_.include(most_);
  blocks_.shrink_to_fit();
  const std::size_t slots = blocks_.size() * kSlotsPerEightBlocks / 8 + 1;
  index_bits_ = static_cast<int>(std::bit_width(blocks_.size()));
  const std::uint32_t mask = index_mask(index_bits_);
  slots_ = std::vector<std::uint32_t>(slots, mask);
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    Entry& entry = blocks_[i];
    for (std::size_t word = 1; word < entry.words.size(); ++word) {
      entry.before[word] = static_cast<std::uint16_t>(entry.before[word - 1] + ones(entry.words[word - 1]));
    }
    const std::uint32_t hash = voxel_hash(entry.key);
    std::size_t slot = home_slot(hash, slots);
    while ((slots_[slot] & mask) != mask) slot = slot + 1 == slots ? 0 : slot + 1;
    slots_[slot] = tag_of(hash, index_bits_) | static_cast<std::uint32_t>(i);
  }
}

std::uint32_t VoxelIndex::find_block(const LatticePoint& block) const {
  const std::size_t slots = slots_.size();
  if (slots == 0) return kNone;
  const std::uint32_t hash = voxel_hash(block);
  const std::uint32_t mask = index_mask(index_bits_);
  const std::uint32_t tag = tag_of(hash, index_bits_);
  for (std::size_t slot = home_slot(hash, slots);; slot = slot + 1 == slots ? 0 : slot + 1) {
    const std::uint32_t held = slots_[slot];
    if ((held & mask) == mask) return kNone;
    if ((held & ~mask) == tag && blocks_[held & mask].key == block) return held & mask;
  }
}

VoxelIndex::Block VoxelIndex::block(std::size_t i) const {
  const Entry& entry = blocks_[i];
  const std::uint32_t end = i + 1 < blocks_.size() ? blocks_[i + 1].first_rank : size_;
  return {entry.key, entry.first_rank, end - entry.first_rank};
}

}  // namespace arris::tiling
