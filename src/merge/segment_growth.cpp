#include "merge/segment_growth.h"

#include <algorithm>

#include "merge/group_numbers.h"

namespace arris::merge {

SegmentGrowth::SegmentGrowth(std::uint64_t points, std::uint32_t min_points)
    : min_points_(min_points), labels_(points, 0) {}

void SegmentGrowth::add(const TileGrowth& tile) {
  std::uint32_t base = 0;
  {
    const std::lock_guard lock(mutex_);
    base = static_cast<std::uint32_t>(sizes_.size());
    sizes_.insert(sizes_.end(), tile.sizes.begin(), tile.sizes.end());
    discs_.insert(discs_.end(), tile.discs.begin(), tile.discs.end());
    for (TileGrowth::Touched member : tile.touched) {
      member.component += base;
      touched_.push_back(member);
    }
    for (TileGrowth::Offer offer : tile.offers) {
      offer.component += base;
      offers_.push_back(offer);
    }
  }
  // Every point is a query of one tile only: no other thread writes here.
  for (const TileGrowth::Member& member : tile.members) labels_[member.id] = base + member.component;
}

void SegmentGrowth::join_touched() {
  for (const TileGrowth::Touched& link : touched_) {
    std::uint32_t& label = labels_[link.id];
    if (label == 0) {  // It had no link of its own.
      label = link.component;
      ++sizes_[link.component - 1];
      discs_[link.component - 1] += link.disc;
    } else {
      sets_.join(label - 1, link.component - 1);
    }
  }
  touched_ = {};
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
  sets_ = DisjointSets(sizes_.size());
  join_touched();
  take_offers();
  number();
  return {std::move(labels_), std::move(discs_)};
}

}  // namespace arris::merge
