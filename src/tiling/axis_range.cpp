#include "tiling/axis_range.h"

#include <algorithm>
#include <cmath>

namespace arris::tiling {
namespace {

constexpr std::size_t kMostCells = 4096;

}  // namespace

void AxisRange::add(double coordinate) {
  if (!(std::abs(coordinate) <= kLargestCoordinate)) return;
  min_ = points_ == 0 ? coordinate : std::min(min_, coordinate);
  max_ = points_ == 0 ? coordinate : std::max(max_, coordinate);
  ++points_;
  count_cell(static_cast<std::int64_t>(std::floor(coordinate / cell_)));
}

void AxisRange::count_cell(std::int64_t cell) {
  if (last_count_ && cell == last_cell_) {
    ++*last_count_;
    return;
  }
  last_cell_ = cell;
  last_count_ = &cells_[cell];
  ++*last_count_;
  while (cells_.size() > kMostCells) {
    std::map<std::int64_t, std::uint64_t> wider;
    for (const auto& [index, count] : cells_) wider[index >> 1] += count;
    cells_ = std::move(wider);
    cell_ *= 2.0;  // Exact, so that floor(c / (2 w)) is floor(c / w) >> 1 for every coordinate.
    last_count_ = nullptr;
  }
}

std::optional<AxisRange::Window> AxisRange::window(double length) const {
  if (points_ == 0) return Window{};
  if (max_ - min_ <= length) return Window{min_, max_};
  std::uint64_t best = 0, inside = 0;
  Window window;
  auto first = cells_.begin();
  for (auto last = cells_.begin(); last != cells_.end(); ++last) {
    inside += last->second;
    while (first != cells_.end() && static_cast<double>(last->first - first->first + 1) * cell_ > length) {
      inside -= first->second;
      if (first++ == last) break;
    }
    if (inside > best) {
      best = inside;
      window.min = std::max(min_, static_cast<double>(first->first) * cell_);
      window.max = std::min(max_, static_cast<double>(last->first + 1) * cell_);
    }
  }
  if (static_cast<double>(best) < kWindowShare * static_cast<double>(points_)) return std::nullopt;
  return window;
}

}  // namespace arris::tiling
