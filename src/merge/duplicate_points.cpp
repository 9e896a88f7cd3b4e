#include "merge/duplicate_points.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace arris::merge {
namespace {

constexpr std::size_t kBlock = 64 * 1024;

}  // namespace

DuplicatePoints::DuplicatePoints(std::filesystem::path file) : file_(std::move(file)) {}

void DuplicatePoints::append(const TilePoints& tile) {
  std::vector<DuplicatePoint> points;
  for (const auto& [id, entry] : tile.duplicates) {
    if (!tile.core.contains(tile.positions[entry])) continue;
    points.push_back(
        {static_cast<std::uint32_t>(id), static_cast<std::uint32_t>(tile.ids[entry]), tile.positions[entry]});
  }
  if (points.empty()) return;
  const std::lock_guard lock(mutex_);
  file_.append(std::as_bytes(std::span(points)));
}

void DuplicatePoints::for_each(const std::function<void(const DuplicatePoint&)>& use) const {
  std::vector<DuplicatePoint> points;
  const std::uint64_t all = file_.size_bytes() / sizeof(DuplicatePoint);
  for (std::uint64_t first = 0; first < all; first += kBlock) {
    points.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, all - first)));
    file_.read_at(first * sizeof(DuplicatePoint), std::as_writable_bytes(std::span(points)));
    for (const DuplicatePoint& point : points) use(point);
  }
}

}  // namespace arris::merge
