#include "tiling/voxel_lane.h"

#include <algorithm>
#include <array>

#include "core/prefetch.h"
#include "tiling/voxel_batch.h"
#include "tiling/voxel_hash.h"

namespace arris::tiling {
namespace {

constexpr std::size_t kBatch = VoxelBatch::kSize;
constexpr std::size_t kFirstSlots = std::size_t{1} << 16;
constexpr std::size_t kGrowth = 8;
// Where it is known how many sums are likely there are never many more.
constexpr std::size_t kLikelyGrowth = 2;
constexpr std::size_t kSpareShare = 8;
constexpr std::uint32_t kFull = 0xffffffffU;
// No more memory than sorting takes afterwards.
constexpr std::size_t kSlotsPerSum = 3;
// Bits of the hash that choose neither the line of a slot nor its place in the line, but for the largest tables.
constexpr int kLaneBits = 8;

}  // namespace

VoxelLane::VoxelLane(const VoxelGrid& grid, std::uint32_t number, const LaneBlocks& blocks, VoxelSums* sums,
                     std::size_t likely_sums)
    : grid_(grid),
      number_(number),
      blocks_(blocks),
      sums_(sums),
      likely_sums_(likely_sums),
      growth_(likely_sums > 0 ? kLikelyGrowth : kGrowth) {}

void VoxelLane::set_limits(std::size_t sums, std::uint32_t points) {
  capacity_ = sums;
  most_points_ = points;
  if (first_slots_ > 0) return;
  const std::size_t likely_slots = kSlotsPerSum * (likely_sums_ + likely_sums_ / kSpareShare);
  first_slots_ = std::min(std::max(kFirstSlots, likely_slots), kSlotsPerSum * (capacity_ + 1));
}

void VoxelLane::start_colours(ColourSums* colours) {
  colours_ = colours;
  for (std::size_t i = 0; i < size_; ++i) colours_[blocks_.index(number_, i)] = {};
}

void VoxelLane::make_slots() {
  if (slots_.size() == 0) rehash(first_slots_);
}

void VoxelLane::free_slots() {
  slots_ = {};
  slots_full_at_ = 0;
}

void VoxelLane::rehash(std::size_t slots) {
  free_slots();
  slots_ = HashSlots(slots, blocks_.index(blocks_.lanes - 1, std::max(capacity_, size_)));
  slots_full_at_ = slots / kSlotsPerSum;
  // Of sums of one voxel the last is the one that is not full.
  constexpr std::size_t kAhead = 16;
  for (std::size_t i = size_; i > 0; --i) {
    if (i > kAhead) slots_.prefetch(voxel_hash(sums_[blocks_.index(number_, i - 1 - kAhead)].key));
    const std::size_t index = blocks_.index(number_, i - 1);
    const std::uint32_t hash = voxel_hash(sums_[index].key);
    const std::size_t slot = find(sums_[index].key, hash);
    if (slots_.at(slot) == HashSlots::kNone) slots_.set(slot, hash, static_cast<std::uint32_t>(index));
  }
}

inline std::size_t VoxelLane::find(const LatticePoint& key, std::uint32_t hash) const {
  return slots_.find(hash, [&](std::uint32_t index) { return sums_[index].key == key; });
}

inline std::uint32_t VoxelLane::begin_sum(const LatticePoint& key) {
  const std::size_t index = blocks_.index(number_, size_++);
  sums_[index] = {key, 0, {}};
  if (colours_ != nullptr) colours_[index] = {};
  return static_cast<std::uint32_t>(index);
}

/// Index of the sum to add to, kFull if there is none and no room.
inline std::uint32_t VoxelLane::find_or_begin(const LatticePoint& key, std::uint32_t hash) {
  std::size_t slot = find(key, hash);
  if (const std::uint32_t index = slots_.at(slot); index != HashSlots::kNone && sums_[index].points < most_points_) {
    return index;
  }
  if (size_ >= capacity_) return kFull;
  if (size_ >= slots_full_at_) {
    first_slots_ = std::min(growth_ * slots_.size(), kSlotsPerSum * (capacity_ + 1));
    rehash(first_slots_);
    slot = find(key, hash);
  }
  const std::uint32_t index = begin_sum(key);
  slots_.set(slot, hash, index);
  return index;
}

/// @return how many of the batch are added.
template <bool kColours>
std::size_t VoxelLane::add_batch(const VoxelBatch& batch, std::size_t count) {
  make_slots();
  // Most misses of the cache are over before the points are added one by one.
  for (std::size_t i = 0; i < count; ++i) slots_.prefetch(batch.hash[i]);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t guess = slots_.first(batch.hash[i]);
    if (guess != HashSlots::kNone) prefetch(&sums_[guess]);
  }
  std::uint32_t index = kFull;
  for (std::size_t i = 0; i < count; ++i) {
    const LatticePoint key = batch.key(i);
    if (index == kFull || !(sums_[index].key == key) || sums_[index].points >= most_points_) {
      index = find_or_begin(key, batch.hash[i]);
      if (index == kFull) return i;
    }
    VoxelSums& sums = sums_[index];
    ++sums.points;
    sums.offset[0] += batch.offset_x[i];
    sums.offset[1] += batch.offset_y[i];
    sums.offset[2] += batch.offset_z[i];
    if constexpr (kColours) {
      for (std::size_t channel = 0; channel < 3; ++channel) colours_[index][channel] += batch.colours[i][channel];
    }
  }
  return count;
}

/// Batch by batch. @param place  of the i-th point to be added among all.
template <class Place>
std::size_t VoxelLane::add_each(std::span<const LatticePoint> positions, std::span<const RawColour> colours,
                                std::size_t size, const Place& place) {
  VoxelBatch batch;
  for (std::size_t done = 0; done < size;) {
    const std::size_t count = std::min(kBatch, size - done);
    batch.fill(grid_, positions, colours, count, [&](std::size_t i) { return place(done + i); });
    const std::size_t added = colours.empty() ? add_batch<false>(batch, count) : add_batch<true>(batch, count);
    done += added;
    if (added < count) return done;
  }
  return size;
}

std::size_t VoxelLane::add(std::span<const LatticePoint> positions, std::span<const RawColour> colours,
                           std::span<const std::uint32_t> own) {
  return add_each(positions, colours, own.size(), [&](std::size_t i) { return own[i]; });
}

std::size_t VoxelLane::add_all(std::span<const LatticePoint> positions, std::span<const RawColour> colours) {
  return add_each(positions, colours, positions.size(), [](std::size_t i) { return i; });
}

void VoxelLane::deal(const VoxelGrid& grid, std::span<const LatticePoint> positions, std::span<LanePoints> lanes) {
  std::array<std::uint32_t*, kMostLanes> ends;
  for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
    lanes[lane].resize(positions.size());
    ends[lane] = lanes[lane].data();
  }
  VoxelBatch batch;
  for (std::size_t begin = 0; begin < positions.size(); begin += kBatch) {
    const std::size_t count = std::min(kBatch, positions.size() - begin);
    batch.fill(grid, positions, {}, count, [&](std::size_t i) { return begin + i; });
    for (std::size_t i = 0; i < count; ++i)
      *ends[batch.hash[i] >> kLaneBits & (lanes.size() - 1)]++ = static_cast<std::uint32_t>(begin + i);
  }
  for (std::size_t lane = 0; lane < lanes.size(); ++lane)
    lanes[lane].resize(static_cast<std::size_t>(ends[lane] - lanes[lane].data()));
}

}  // namespace arris::tiling
