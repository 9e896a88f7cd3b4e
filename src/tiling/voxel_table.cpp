#include "tiling/voxel_table.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>

#include "core/parallel.h"

namespace arris::tiling {
namespace {

/// No index of a sum is as large.
constexpr std::size_t kMostSums = 0xffff0000U;
/// Points that are worth waking a thread for.
constexpr std::size_t kLeastPoints = 2048;
/// There may be so many fewer sums than were likely.
constexpr std::size_t kUnlikelyShare = 8;
constexpr std::size_t kTouchedSums = 64 * 1024;

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
  blocks_ = {lane_count()};
  sums_ = PageArray<VoxelSums>(room());
  for (std::uint32_t i = 0; i < blocks_.lanes; ++i)
    lanes_.emplace_back(grid, i, blocks_, &sums_[0], likely_sums / blocks_.lanes);
  set_limits();
  touch(likely_sums - likely_sums / kUnlikelyShare);
}

/// Lanes go in turn: where the system makes a page for one of them, which takes as long as thousands of points on some
/// machines, others soon have to wait. All threads touch the pages of so many sums before, in any order, and make
/// slots.
void VoxelTable::touch(std::size_t sums) {
  if (lanes_.size() == 1) return;
  const std::span<VoxelSums> all = sums_.first(std::min(sums, room()));
  parallel_for_chunks(all.size(), kTouchedSums, [&](std::size_t begin, std::size_t end) {
    touch_pages(&all[begin], (end - begin) * sizeof(VoxelSums));
  });
  for (VoxelLane& lane : lanes_) lane.make_slots();
}

/// Of each lane.
std::size_t VoxelTable::lane_sums(bool colours) const {
  return std::clamp<std::size_t>(size_bytes_ / sum_bytes(colours), blocks_.lanes, kMostSums) / blocks_.lanes;
}

/// Of the arrays. Blocks that nothing is written to take no memory.
std::size_t VoxelTable::room() const {
  return blocks_.index(blocks_.lanes - 1, lane_sums(false)) + 1;
}

void VoxelTable::set_limits() {
  for (VoxelLane& lane : lanes_)
    lane.set_limits(lane_sums(has_colours_), most_points_summed(grid_.side_steps(), has_colours_));
}

void VoxelTable::start_colours() {
  if (has_colours_) return;
  has_colours_ = true;
  set_limits();
  colours_ = PageArray<ColourSums>(room());
  for (VoxelLane& lane : lanes_) lane.start_colours(&colours_[0]);
}

bool VoxelTable::Dealt::all_added() const {
  return std::accumulate(added_.begin(), added_.end(), std::size_t{0}) == size_;
}

void VoxelTable::deal(std::span<const LatticePoint> positions, Dealt& dealt) const {
  dealt.size_ = positions.size();
  dealt.added_.assign(lanes_.size(), 0);
  if (lanes_.size() == 1) return;
  dealt.own_.resize(lanes_.size());
  VoxelLane::deal(grid_, positions, dealt.own_);
}

bool VoxelTable::add_to_lane(std::size_t lane, std::span<const LatticePoint> positions,
                             std::span<const RawColour> colours, Dealt& dealt) {
  std::size_t& added = dealt.added_[lane];
  if (lanes_.size() > 1) {
    const std::span<const std::uint32_t> own(dealt.own_[lane]);
    added += lanes_[lane].add(positions, colours, own.subspan(added));
    return added == own.size();
  }
  added += lanes_[lane].add_all(positions.subspan(added), colours.empty() ? colours : colours.subspan(added));
  return added == positions.size();
}

bool VoxelTable::add(std::span<const LatticePoint> positions, std::span<const RawColour> colours) {
  if (!colours.empty()) start_colours();
  if (dealt_.all_added()) deal(positions, dealt_);
  const auto add_to = [&](std::size_t lane) { add_to_lane(lane, positions, colours, dealt_); };
  if (positions.size() < kLeastPoints) {
    for (std::size_t lane = 0; lane < lanes_.size(); ++lane) add_to(lane);
  } else {
    parallel_for_chunks(lanes_.size(), 1, [&](std::size_t lane, std::size_t) { add_to(lane); });
  }
  return dealt_.all_added();
}

std::size_t VoxelTable::size() const {
  std::size_t sum = 0;
  for (const VoxelLane& lane : lanes_) sum += lane.size();
  return sum;
}

/// All sums come to lie side by side: from the first block that is not full those behind it move up.
void VoxelTable::close_up() {
  constexpr std::size_t kBlock = LaneBlocks::kSize;
  const auto [least, most] = std::ranges::minmax_element(lanes_, {}, [](const VoxelLane& lane) { return lane.size(); });
  const std::size_t first = least->size() / kBlock * kBlock;
  std::size_t end = first * lanes_.size();
  for (std::size_t begin = first; begin < most->size(); begin += kBlock) {
    for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
      if (lanes_[lane].size() <= begin) continue;
      const std::size_t count = std::min(lanes_[lane].size() - begin, kBlock), from = blocks_.index(lane, begin);
      std::memmove(&sums_[end], &sums_[from], count * sizeof(VoxelSums));
      if (has_colours_) std::memmove(&colours_[end], &colours_[from], count * sizeof(ColourSums));
      end += count;
    }
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
