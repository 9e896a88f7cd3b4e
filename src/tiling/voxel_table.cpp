#include "tiling/voxel_table.h"

#include <algorithm>
#include <array>

#include "tiling/voxel_hash.h"

namespace arris::tiling {
namespace {

constexpr std::size_t kBatch = 256;
constexpr std::size_t kFirstSlots = 4096;
constexpr std::uint32_t kFull = 0xffffffffU;

// A slot and a half per sum at least, two and a half at most.
constexpr std::size_t slots_for(std::size_t sums) {
  return sums + sums / 2 + 1;
}

}  // namespace

/// Voxels of the points of a batch, by arrays.
struct VoxelTable::Batch {
  std::array<std::int32_t, kBatch> x, y, z;
  std::array<std::uint32_t, kBatch> offset_x, offset_y, offset_z, hash;

  LatticePoint key(std::size_t i) const { return {x[i], y[i], z[i]}; }

  void fill(const VoxelGrid& grid, std::span<const LatticePoint> positions) {
    const auto side = static_cast<std::uint32_t>(grid.side_steps());
    const auto offset = [side](std::int32_t position, std::int32_t voxel) {
      return static_cast<std::uint32_t>(position) - static_cast<std::uint32_t>(voxel) * side;  // In [0, side).
    };
    const std::size_t count = positions.size();
    for (std::size_t i = 0; i < count; ++i) {
      x[i] = grid.voxel_of(positions[i].x);
      y[i] = grid.voxel_of(positions[i].y);
      z[i] = grid.voxel_of(positions[i].z);
    }
    for (std::size_t i = 0; i < count; ++i) {
      offset_x[i] = offset(positions[i].x, x[i]);
      offset_y[i] = offset(positions[i].y, y[i]);
      offset_z[i] = offset(positions[i].z, z[i]);
    }
    for (std::size_t i = 0; i < count; ++i) hash[i] = voxel_hash(x[i], y[i], z[i]);
  }
};

VoxelTable::VoxelTable(const VoxelGrid& grid, std::size_t size_bytes) : grid_(grid), size_bytes_(size_bytes) {
  set_capacity();
  sums_.reserve(capacity_);  // Pages that are not written to take no memory.
}

void VoxelTable::set_capacity() {
  // Sorting takes more than the slots, which are freed before.
  const std::size_t bytes = sizeof(VoxelSums) + kOrderBytes + (has_colours_ ? sizeof(ColourSums) : 0);
  capacity_ = std::clamp<std::size_t>(size_bytes_ / bytes, 1, kFull - 1);
  most_points_ = most_points_summed(grid_.side_steps(), has_colours_);
}

void VoxelTable::start_colours() {
  has_colours_ = true;
  set_capacity();
  colours_.reserve(capacity_);
  colours_.resize(sums_.size());
}

void VoxelTable::rehash(std::size_t slots) {
  free_slots();
  slots_.assign(slots, 0);
  slots_full_at_ = slots * 2 / 3;
  // Of sums of one voxel the last is the one that is not full.
  for (std::size_t i = sums_.size(); i > 0; --i) {
    const LatticePoint& key = sums_[i - 1].key;
    std::size_t slot = home_slot(voxel_hash(key), slots);
    while (slots_[slot] != 0 && !(sums_[slots_[slot] - 1].key == key)) slot = slot + 1 == slots ? 0 : slot + 1;
    if (slots_[slot] == 0) slots_[slot] = static_cast<std::uint32_t>(i);
  }
}

void VoxelTable::free_slots() {
  slots_ = {};
  slots_full_at_ = 0;
}

std::uint32_t VoxelTable::begin_sum(const LatticePoint& key) {
  sums_.push_back({key, 0, {}});
  if (has_colours_) colours_.push_back({});
  return static_cast<std::uint32_t>(sums_.size() - 1);
}

/// Index of the sum to add to, kFull if there is none and no room.
template <bool kColours>
std::uint32_t VoxelTable::find_or_begin(const LatticePoint& key, std::uint32_t hash) {
  if (sums_.size() >= slots_full_at_) {
    rehash(std::min(std::max(2 * slots_.size(), kFirstSlots), std::max(slots_for(capacity_ + 1), kFirstSlots)));
  }
  const std::size_t slots = slots_.size();
  std::size_t slot = home_slot(hash, slots);
  for (; slots_[slot] != 0; slot = slot + 1 == slots ? 0 : slot + 1) {
    const std::uint32_t index = slots_[slot] - 1;
    if (!(sums_[index].key == key)) continue;
    if (sums_[index].points < most_points_) return index;
    break;
  }
  if (sums_.size() >= capacity_) return kFull;
  const std::uint32_t index = begin_sum(key);
  slots_[slot] = index + 1;
  return index;
}

template <bool kColours>
std::size_t VoxelTable::add_batch(const Batch& batch, std::size_t count, const RawColour* colours) {
  std::uint32_t index = kFull;
  for (std::size_t i = 0; i < count; ++i) {
    const LatticePoint key = batch.key(i);
    if (index == kFull || !(sums_[index].key == key) || sums_[index].points >= most_points_) {
      index = find_or_begin<kColours>(key, batch.hash[i]);
      if (index == kFull) return i;
    }
    VoxelSums& sums = sums_[index];
    ++sums.points;
    sums.offset[0] += batch.offset_x[i];
    sums.offset[1] += batch.offset_y[i];
    sums.offset[2] += batch.offset_z[i];
    if constexpr (kColours) {
      for (std::size_t channel = 0; channel < 3; ++channel) colours_[index][channel] += colours[i][channel];
    }
  }
  return count;
}

std::size_t VoxelTable::add(std::span<const LatticePoint> positions, std::span<const RawColour> colours) {
  if (!colours.empty() && !has_colours_) start_colours();
  Batch batch;
  for (std::size_t done = 0; done < positions.size();) {
    const std::size_t count = std::min(kBatch, positions.size() - done);
    batch.fill(grid_, positions.subspan(done, count));
    const std::size_t added = colours.empty() ? add_batch<false>(batch, count, nullptr)
                                              : add_batch<true>(batch, count, colours.data() + done);
    done += added;
    if (added < count) return done;
  }
  return positions.size();
}

}  // namespace arris::tiling
