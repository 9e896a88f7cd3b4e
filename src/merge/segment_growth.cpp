#include "merge/segment_growth.h"

#include <algorithm>
#include <atomic>

#include "core/parallel.h"
#include "merge/group_numbers.h"

namespace arris::merge {

SegmentGrowth::SegmentGrowth(std::uint64_t points, std::uint32_t min_points)
    : min_points_(min_points), labels_(points) {
  constexpr std::size_t kGrain = 1 << 19;  // As many as a large page holds, which the system makes meanwhile.
  parallel_for_chunks(labels_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::fill(labels_.begin() + static_cast<std::ptrdiff_t>(begin), labels_.begin() + static_cast<std::ptrdiff_t>(end),
              0U);
  });
}

void SegmentGrowth::add(const TileGrowth& tile) {
  std::uint32_t base = 0;
  {
    const std::lock_guard lock(mutex_);
    base = static_cast<std::uint32_t>(sizes_.size());
    sizes_.insert(sizes_.end(), tile.sizes.begin(), tile.sizes.end());
    discs_.insert(discs_.end(), tile.discs.begin(), tile.discs.end());
    sets_.grow(tile.sizes.size());
  }
  // Every point is a query of one tile only: no other thread writes here. Those that read see a label or none yet.
  for (const TileGrowth::Member& member : tile.members)
    std::atomic_ref(labels_[member.id]).store(base + member.component, std::memory_order_relaxed);
  const std::lock_guard lock(mutex_);
  for (TileGrowth::Touched link : tile.touched) {
    link.component += base;
    if (!join(link)) wait_for(link);
  }
  for (TileGrowth::Offer offer : tile.offers) {
    offer.component += base;
    offers_.push_back(offer);
  }
}

/// False if the point has no label yet.
bool SegmentGrowth::join(const TileGrowth::Touched& link) {
  const std::uint32_t label = std::atomic_ref(labels_[link.id]).load(std::memory_order_relaxed);
  if (label != 0) sets_.join(label - 1, link.component - 1);
  return label != 0;
}

void SegmentGrowth::wait_for(const TileGrowth::Touched& link) {
  constexpr std::size_t kWorthALook = 1 << 16;
  if (waiting_.size() >= std::max(kWorthALook, most_waiting_)) {
    std::erase_if(waiting_, [&](const TileGrowth::Touched& waiting) { return join(waiting); });
    most_waiting_ = 2 * waiting_.size();
  }
  waiting_.push_back(link);
}

/// Points that have no link of their own are of the component that touches them.
void SegmentGrowth::add_touched() {
  for (const TileGrowth::Touched& link : waiting_) {
    if (join(link)) continue;
    labels_[link.id] = link.component;
    ++sizes_[link.component - 1];
    discs_[link.component - 1] += link.disc;
  }
  waiting_ = {};
}

void SegmentGrowth::take_offers() {
  std::sort(offers_.begin(), offers_.end(), [](const TileGrowth::Offer& a, const TileGrowth::Offer& b) {
    if (a.id != b.id) return a.id < b.id;
    return a.alignment != b.alignment ? a.alignment > b.alignment : a.via < b.via;
  });
  for (std::size_t i = 0; i < offers_.size(); ++i) {
    if (i > 0 && offers_[i - 1].id == offers_[i].id) continue;
    labels_[offers_[i].id] = offers_[i].component;
    ++sizes_[offers_[i].component - 1];
  }
  offers_ = {};
}

/// Components become segments, in the order of the smallest ids.
void SegmentGrowth::number() {
  const auto components = static_cast<std::uint32_t>(sizes_.size());
  std::vector<std::uint64_t> points(components);
  for (std::uint32_t c = 0; c < components; ++c) {
    const std::uint32_t root = sets_.find(c);
    points[root] += sizes_[c];
    if (root != c) discs_[root] += discs_[c];
  }
  std::vector<std::uint32_t> group_of(components);
  for (std::uint32_t c = 0; c < components; ++c) {
    const std::uint32_t root = sets_.find(c);
    group_of[c] = points[root] < min_points_ ? 0 : root + 1;
  }
  std::vector<std::uint64_t> discs;
  for (const std::uint32_t group : number_groups(group_of, components, labels_)) discs.push_back(discs_[group - 1]);
  discs_ = std::move(discs);
}

GrownSegments SegmentGrowth::finish() {
  add_touched();
  take_offers();
  number();
  return {std::move(labels_), std::move(discs_)};
}

}  // namespace arris::merge
