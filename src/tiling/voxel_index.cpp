#include "tiling/voxel_index.h"

#include <algorithm>

#include "core/prefetch.h"
#include "tiling/voxel_hash.h"

namespace arris::tiling {
namespace {

constexpr std::size_t kSlotsPerBlock = 2;
constexpr std::size_t kKeysAtATime = 128;

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
  add_slots();
}

VoxelIndex VoxelIndex::selection(std::span<const BlockRange> ranges) const {
  VoxelIndex index;
  for (const BlockRange& range : ranges) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      Entry entry = blocks_[i];
      const std::uint32_t words = ones(entry.parts >> 24);
      const std::uint64_t* const first = &words_[entry.first_word];
      entry.first_rank = index.size_;
      entry.first_word = static_cast<std::uint32_t>(index.words_.size());
      for (std::uint32_t word = 0; word < words; ++word) index.words_.push_back(first[word]);
      index.blocks_.push_back(entry);
      index.size_ += first_rank(i + 1) - first_rank(i);
      index.bounds_.include(key_at(entry.key, 0));
      index.bounds_.include(key_at(entry.key, 64 * kBlockParts - 1));
    }
  }
  if (index.size_ > 0) index.add_slots();
  return index;
}

void VoxelIndex::add_slots() {
  blocks_.shrink_to_fit();
  words_.shrink_to_fit();
  slots_ = HashSlots(blocks_.size() * kSlotsPerBlock, blocks_.size());
  constexpr std::size_t kAhead = 16;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    if (i + kAhead < blocks_.size()) slots_.prefetch(voxel_hash(blocks_[i + kAhead].key));
    const std::uint32_t hash = voxel_hash(blocks_[i].key);
    slots_.set(slots_.find(hash, [](std::uint32_t) { return false; }), hash, static_cast<std::uint32_t>(i));
  }
}

std::size_t VoxelIndex::block_of_rank(std::uint32_t rank) const {
  const std::span<const Entry> blocks = blocks_.span();
  return static_cast<std::size_t>(std::ranges::upper_bound(blocks, rank, {}, &Entry::first_rank) - blocks.begin()) - 1;
}

std::uint32_t VoxelIndex::find_block(const LatticePoint& block) const {
  if (size_ == 0) return kNone;
  return slots_.at(slots_.find(voxel_hash(block), [&](std::uint32_t i) { return blocks_[i].key == block; }));
}

void VoxelIndex::ranks(std::span<const LatticePoint> keys, std::span<std::uint32_t> ranks) const {
  if (size_ == 0) {
    std::ranges::fill(ranks, kNone);
    return;
  }
  for (std::size_t begin = 0; begin < keys.size(); begin += kKeysAtATime) {
    const std::size_t count = std::min(kKeysAtATime, keys.size() - begin);
    ranks_of_some(keys.subspan(begin, count), ranks.subspan(begin, count));
  }
}

/// Step by step for all keys: slots, blocks, words. Keys of one block mostly come one after another.
void VoxelIndex::ranks_of_some(std::span<const LatticePoint> keys, std::span<std::uint32_t> ranks) const {
  struct Run {
    LatticePoint block;
    std::uint32_t hash, begin;
  };
  std::array<Run, kKeysAtATime> runs;
  std::array<std::uint32_t, kKeysAtATime> found;
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    const LatticePoint block{keys[i].x >> kLog2, keys[i].y >> kLog2, keys[i].z >> kLog2};
    if (count > 0 && runs[count - 1].block == block) continue;
    runs[count] = {block, voxel_hash(block), i};
    slots_.prefetch(runs[count++].hash);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t guess = slots_.first(runs[i].hash);
    if (guess != kNone) prefetch(&blocks_[guess]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Run& run = runs[i];
    found[i] = slots_.at(slots_.find(run.hash, [&](std::uint32_t block) { return blocks_[block].key == run.block; }));
    if (found[i] != kNone) prefetch(&words_[word_of(blocks_[found[i]], place_in_block(keys[run.begin]) >> 6)]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t end = i + 1 < count ? runs[i + 1].begin : keys.size();
    for (std::size_t key = runs[i].begin; key < end; ++key)
      ranks[key] = found[i] == kNone ? kNone : rank_in(blocks_[found[i]], place_in_block(keys[key]));
  }
}

void VoxelIndex::ranks_around(const LatticePoint& key, std::uint32_t& hint,
                              std::array<std::uint32_t, 27>& ranks) const {
  // Per axis the three positions lie in one block or two.
  struct Axis {
    std::array<std::int32_t, 2> blocks;
    int count;
    std::array<std::uint32_t, 3> which, place;
  };
  std::array<Axis, 3> axes;
  for (int axis = 0; axis < 3; ++axis) {
    Axis& a = axes[axis];
    const std::int64_t first = std::int64_t{key[axis]} - 1;  // Blocks beyond int32 do not exist and are not found.
    a.blocks = {static_cast<std::int32_t>(first >> kLog2), static_cast<std::int32_t>((first + 2) >> kLog2)};
    a.count = a.blocks[0] == a.blocks[1] ? 1 : 2;
    for (int i = 0; i < 3; ++i) {
      a.which[i] = (first + i) >> kLog2 != a.blocks[0];
      a.place[i] = std::uint32_t{kSpread[(first + i) & 7]} << (2 - axis);
    }
  }
  std::array<const Entry*, 8> entries;
  for (int i = 0; i < axes[0].count; ++i) {
    for (int j = 0; j < axes[1].count; ++j) {
      for (int k = 0; k < axes[2].count; ++k) {
        const LatticePoint block{axes[0].blocks[i], axes[1].blocks[j], axes[2].blocks[k]};
        const bool hinted = hint < blocks_.size() && blocks_[hint].key == block;
        const std::uint32_t found = hinted ? hint : find_block(block);
        entries[4 * i + 2 * j + k] = found == kNone ? nullptr : &blocks_[found];
      }
    }
  }
  std::size_t at = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k, ++at) {
        const Entry* const entry = entries[4 * axes[0].which[i] + 2 * axes[1].which[j] + axes[2].which[k]];
        ranks[at] = entry ? rank_in(*entry, axes[0].place[i] | axes[1].place[j] | axes[2].place[k]) : kNone;
      }
    }
  }
  // The block of the voxel itself is the best guess for the next one.
  if (const Entry* const own = entries[4 * axes[0].which[1] + 2 * axes[1].which[1] + axes[2].which[1]]) {
    hint = static_cast<std::uint32_t>(own - &blocks_[0]);
  }
}

VoxelIndex::Block VoxelIndex::block(std::size_t i) const {
  const Entry& entry = blocks_[i];
  return {entry.key, entry.first_rank, first_rank(i + 1) - entry.first_rank};
}

}  // namespace arris::tiling
