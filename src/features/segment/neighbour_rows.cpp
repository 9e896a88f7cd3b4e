#include "features/segment/neighbour_rows.h"

#include <algorithm>

namespace arris {

NeighbourRows::NeighbourRows(std::size_t slots, std::size_t most)
    : most_(most), near_(slots * most + kMostNeighbours), counts_(slots, 0) {}

NeighbourRows::Sheet NeighbourRows::take_sheet() {
  const std::lock_guard lock(mutex_);
  if (!open_.empty()) {
    const Sheet sheet = open_.back();
    open_.pop_back();
    return sheet;
  }
  sheets_.push_back(std::make_unique_for_overwrite<std::uint32_t[]>(kSheetRows * most_));
  return {static_cast<std::uint32_t>(sheets_.size() - 1), 0, sheets_.back().get()};
}

void NeighbourRows::return_sheet(const Sheet& sheet) {
  if (sheet.rows == nullptr || sheet.used == kSheetRows) return;
  const std::lock_guard lock(mutex_);
  open_.push_back(sheet);
}

void NeighbourRows::Writer::put(std::uint32_t slot, std::span<const std::uint32_t> neighbours) {
  std::int16_t* const row = rows_.near_.data() + std::size_t{slot} * rows_.most_;
  bool far = false;
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const auto difference = static_cast<std::int32_t>(neighbours[i] - slot);
    row[i] = static_cast<std::int16_t>(difference);
    far |= row[i] != difference;
  }
  rows_.counts_[slot] = static_cast<std::uint8_t>(neighbours.size());
  if (!far) return;
  if (sheet_.rows == nullptr || sheet_.used == kSheetRows) sheet_ = rows_.take_sheet();
  std::copy(neighbours.begin(), neighbours.end(), sheet_.rows + std::size_t{sheet_.used} * rows_.most_);
  const std::uint32_t at = sheet_.number * kSheetRows + sheet_.used++;
  std::memcpy(row, &at, sizeof(at));
  rows_.counts_[slot] |= kFar;
}

}  // namespace arris
