#include "features/segment/neighbour_rows.h"

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

std::uint32_t* NeighbourRows::Writer::far_row(std::uint32_t slot) {
  if (sheet_.rows == nullptr || sheet_.used == kSheetRows) sheet_ = rows_.take_sheet();
  const std::uint32_t at = sheet_.number * kSheetRows + sheet_.used;
  std::memcpy(rows_.near_.data() + std::size_t{slot} * rows_.most_, &at, sizeof(at));
  rows_.counts_[slot] |= kFar;
  return sheet_.rows + std::size_t{sheet_.used++} * rows_.most_;
}

}  // namespace arris
