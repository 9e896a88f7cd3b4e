#pragma once
/// @file Records found at positions, as records of points.

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/tile_points.h"
#include "features/contour/contour_record.h"
#include "features/neighbourhood/point_tree.h"

namespace arris {

/// What was found at the position of a slot of the tree, which stands for its duplicates too.
struct FoundRecord {
  std::uint32_t slot;
  ContourRecord record;
};
using FoundRecords = PageVector<FoundRecord>;

/// One record per id at the positions, duplicates included; ascending ids.
/// @param found  any order, at most one per slot.
inline ContourRecords records_of(const PointTree& tree, const TilePoints& tile, std::span<const FoundRecord> found) {
  ContourRecords records;
  records.reserve(found.size());
  for (const FoundRecord& f : found) records.push_back(f.record);
  if (!tile.duplicates.empty()) {
    std::vector<std::pair<std::uint32_t, const ContourRecord*>> at;
    for (const FoundRecord& f : found) at.emplace_back(tree.entry(f.slot), &f.record);
    std::sort(at.begin(), at.end());
    for (const auto& [id, entry] : tile.duplicates) {
      const auto it = std::lower_bound(at.begin(), at.end(), entry,
                                       [](const auto& a, std::uint32_t wanted) { return a.first < wanted; });
      if (it == at.end() || it->first != entry) continue;
      records.push_back(*it->second);
      records.back().id = id;
    }
  }
  std::sort(records.begin(), records.end(), [](const ContourRecord& a, const ContourRecord& b) { return a.id < b.id; });
  return records;
}

}  // namespace arris
