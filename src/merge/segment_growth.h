#pragma once
/// @file Joins the components of all tiles to segments of the whole scan.

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <vector>

#include "core/disjoint_sets.h"
#include "core/tile_points.h"
#include "features/segment/tile_growth.h"
#include "merge/point_labels.h"

namespace arris::merge {

/// Segments of a scan: numbered 1 .. sizes.size() in the order of their smallest ids.
struct GrownSegments {
  PointLabels labels;
  std::vector<std::uint64_t> discs;  ///< See TileGrowth::discs.
};

/// Takes the tiles' results in any order; what finish() gives does not depend on it. Memory: 4 bytes per point of the
/// scan; 16 per component; 16 per link to a point whose tile has not come yet, or that has no link of its own; 32 per
/// offer.
class SegmentGrowth {
 public:
  /// @param points  ids are in [0, points), points < TileGrowth::kNoId.
  SegmentGrowth(std::uint64_t points, std::uint32_t min_points);

  /// Uses all of a tile's result but its frontier. Thread-safe.
  void add(const TileGrowth& tile);

  /// Segments of fewer than min_points different positions are none. Call once, after the last add().
  GrownSegments finish();

 private:
  bool join(const TileGrowth::Touched& link);
  void wait_for(const TileGrowth::Touched& link);
  void add_touched();
  void take_offers();
  void number();

  std::uint32_t min_points_;
  std::mutex mutex_;
  PointLabels labels_;  ///< Components, then segments.
  std::vector<std::uint32_t> sizes_;
  std::vector<std::uint64_t> discs_;
  std::vector<TileGrowth::Touched> waiting_;  ///< Links to points without a label.
  std::size_t most_waiting_ = 0;              ///< With more, it is worth looking for those that have got one.
  std::vector<TileGrowth::Offer> offers_;
  DisjointSets sets_;  ///< Of components.
};

}  // namespace arris::merge
