#include "features/liu/contour_accumulator.h"

#include <algorithm>
#include <atomic>
#include <bit>

#include "core/columns.h"

namespace arris {
namespace {

constexpr std::uint8_t kIsolatedMark = 128;

}  // namespace

ContourAccumulator::ContourAccumulator(std::size_t points, bool folds)
    : marks_(points, 0), gap_deg_(points, 0.0F), votes_(folds ? points : 0, 0), strongest_(folds ? points : 0, 0) {}

void ContourAccumulator::add_gap(std::size_t slot, const GapResult& gap) {
  if (gap.boundary_deg > 0.0) {
    marks_[slot] |= kBoundary;
    gap_deg_[slot] = static_cast<float>(gap.boundary_deg);
  } else if (gap.weak_deg > 0.0) {
    marks_[slot] |= kWeakBoundary;
    gap_deg_[slot] = static_cast<float>(gap.weak_deg);
  }
}

void ContourAccumulator::add_fold(std::size_t slot, float strength, float angle_deg) {
  std::atomic_ref(votes_[slot]).fetch_add(1, std::memory_order_relaxed);
  const std::uint64_t mine =
      std::uint64_t{std::bit_cast<std::uint32_t>(strength)} << 32 | ~std::bit_cast<std::uint32_t>(angle_deg);
  const std::atomic_ref strongest(strongest_[slot]);
  std::uint64_t seen = strongest.load(std::memory_order_relaxed);
  while (seen < mine && !strongest.compare_exchange_weak(seen, mine, std::memory_order_relaxed)) {
  }
}

void ContourAccumulator::add_isolated(std::size_t slot) {
  marks_[slot] |= kIsolatedMark;
}

ContourRecord ContourAccumulator::record(std::size_t slot) const {
  ContourRecord record;
  record.classes = marks_[slot] & static_cast<std::uint8_t>(~kIsolatedMark);
  record.gap_deg = gap_deg_[slot];
  if (!votes_.empty() && votes_[slot] > 0) {
    record.classes |= kFold;
    record.votes = votes_[slot];
    record.fold_strength = std::bit_cast<float>(static_cast<std::uint32_t>(strongest_[slot] >> 32));
    record.fold_angle_deg = std::bit_cast<float>(~static_cast<std::uint32_t>(strongest_[slot]));
  }
  return record;
}

ContourAccumulator::Outcome ContourAccumulator::finish(const PointTree& tree, const TilePoints& tile) const {
  Outcome outcome;
  const auto is_contour = [this](std::size_t slot) {
    return (marks_[slot] & ~kIsolatedMark) != 0 || (!votes_.empty() && votes_[slot] > 0);
  };
  std::size_t contours = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> slot_of_entry;  // Of all marked points, for their duplicates.
  for (std::size_t slot = 0; slot < marks_.size(); ++slot) {
    const bool isolated = (marks_[slot] & kIsolatedMark) != 0;
    outcome.isolated += isolated;
    contours += is_contour(slot);
  }
  outcome.records.reserve(contours);
  for (std::size_t slot = 0; slot < marks_.size(); ++slot) {
    if (is_contour(slot)) {
      outcome.records.push_back(record(slot));
      outcome.records.back().id = tree.id(slot);
    }
    if (!tile.duplicates.empty() && (is_contour(slot) || marks_[slot] != 0)) {
      slot_of_entry.emplace_back(tree.entry(slot), static_cast<std::uint32_t>(slot));
    }
  }
  std::sort(slot_of_entry.begin(), slot_of_entry.end());
  for (const auto& [id, entry] : tile.duplicates) {
    const auto found = std::lower_bound(slot_of_entry.begin(), slot_of_entry.end(), std::pair{entry, std::uint32_t{0}});
    if (found == slot_of_entry.end() || found->first != entry) continue;
    outcome.isolated += (marks_[found->second] & kIsolatedMark) != 0;
    if (!is_contour(found->second)) continue;
    outcome.records.push_back(record(found->second));
    outcome.records.back().id = id;
  }
  std::sort(outcome.records.begin(), outcome.records.end(),
            [](const ContourRecord& a, const ContourRecord& b) { return a.id < b.id; });
  return outcome;
}

}  // namespace arris
