#include "tiling/voxel_table.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/parallel.h"

namespace arris::tiling {
namespace {

/// No index of a sum is as large.
constexpr std::size_t kMostSums = 0xfffffffeU;
/// Points that are worth waking a thread for.
constexpr std::size_t kLeastPoints = 2048;

std::uint32_t lane_count() {
  const auto threads = static_cast<std::uint32_t>(std::max(1, loop_threads()));
  return std::min(std::bit_floor(threads), VoxelLane::kMostLanes);
}

/// Sorting takes more than the slots, which are freed before.
std::size_t sum_bytes(bool colours) {
  return sizeof(VoxelSums) + kOrderBytes + (colours ? sizeof(ColourSums) : 0);
}

}  // namespace

VoxelTable::VoxelTable(const VoxelGrid& grid, std::size_t size_bytes, std::size_t likely_sums)
    : grid_(grid), size_bytes_(size_bytes) {
  const std::uint32_t lanes = lane_count();
  lane_sums_ = std::clamp<std::size_t>(size_bytes_ / sum_bytes(false), lanes, kMostSums) / lanes;
  sums_ = PageArray<VoxelSums>(lane_sums_ * lanes);
  for (std::uint32_t i = 0; i < lanes; ++i)
    lanes_.emplace_back(grid, i, lanes, &sums_[lane_sums_ * i], likely_sums / lanes);
  looked_at_.assign(lanes, 0);
  set_limits();
}

void VoxelTable::set_limits() {
  const std::size_t sums = std::clamp<std::size_t>(size_bytes_ / sum_bytes(has_colours_), lanes_.size(), kMostSums);
  for (VoxelLane& lane : lanes_)
    lane.set_limits(sums / lanes_.size(), most_points_summed(grid_.side_steps(), has_colours_));
}

void VoxelTable::start_colours() {
  has_colours_ = true;
  set_limits();
  colours_ = PageArray<ColourSums>(lane_sums_ * lanes_.size());
  for (std::size_t i = 0; i < lanes_.size(); ++i) lanes_[i].start_colours(&colours_[lane_sums_ * i]);
}

bool VoxelTable::add(std::span<const LatticePoint> positions, std::span<const RawColour> colours) {
  if (!colours.empty() && !has_colours_) start_colours();
  const auto add_to = [&](std::size_t lane) {
    looked_at_[lane] = lanes_[lane].add(positions, colours, looked_at_[lane]);
  };
  if (positions.size() < kLeastPoints) {
    for (std::size_t lane = 0; lane < lanes_.size(); ++lane) add_to(lane);
  } else {
    parallel_for_chunks(lanes_.size(), 1, [&](std::size_t lane, std::size_t) { add_to(lane); });
  }
  if (!std::ranges::all_of(looked_at_, [&](std::size_t at) { return at == positions.size(); })) return false;
  std::ranges::fill(looked_at_, 0);
  return true;
}

std::size_t VoxelTable::size() const {
  std::size_t sum = 0;
  for (const VoxelLane& lane : lanes_) sum += lane.size();
  return sum;
}

/// All sums come to lie side by side.
void VoxelTable::close_up() {
  std::size_t end = lanes_[0].size();
  for (std::size_t i = 1; i < lanes_.size(); ++i) {
    const std::size_t count = lanes_[i].size();
    if (count == 0) continue;
    std::memmove(&sums_[end], &sums_[lane_sums_ * i], count * sizeof(VoxelSums));
    if (has_colours_) std::memmove(&colours_[end], &colours_[lane_sums_ * i], count * sizeof(ColourSums));
    end += count;
  }
}

VoxelTable::Sorted VoxelTable::sorted() {
  for (VoxelLane& lane : lanes_) lane.free_slots();
  close_up();
  return Sorted(*this);
}

void VoxelTable::clear() {
  for (VoxelLane& lane : lanes_) lane.clear();
}

}  // namespace arris::tiling
