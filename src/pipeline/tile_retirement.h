#pragma once
/// @file When tile files are not needed any more: disk is for those that may still be asked.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "features/contour/tile_contours.h"
#include "tiling/box_tree.h"
#include "tiling/tile_plan.h"

namespace arris::pipeline {

/// After its analysis a tile's file serves the queries that tiles around it could not prove, none of which reaches
/// farther than a bound. So it goes once all tiles within that bound are analysed and none of their unproven queries
/// can reach it. Not thread-safe. Memory: about 150 bytes per tile. Plans in which most tiles lie within the bound of
/// each other (far fewer points than space) keep all files: there is little in them.
class TileRetirement {
 public:
  /// @param farthest_steps  Chebyshev reach that no query exceeds; 0: there are no unproven queries.
  /// @param asks_again      queries may turn out to need more than the reach they tell first, up to the most that they
  ///                        tell, or farthest_steps.
  TileRetirement(const tiling::TilePlan& plan, std::int64_t farthest_steps, bool asks_again);

  /// Call once per tile, in any order. @return the tiles whose files may go now.
  std::vector<std::size_t> analysed(std::size_t tile, std::span<const UnprovenQuery> unproven);

 private:
  static constexpr std::uint32_t kKept = 0xffffffffU;

  /// Calls use(tile) for all tiles whose cores touch a box.
  template <class Use>
  void for_each_touching(const LatticeBox& box, Use&& use) const {
    cores_.walk([&](const LatticeBox& bounds, std::size_t begin, std::size_t end) {
      if (!bounds.intersects(box)) return false;
      if (end - begin == 1) use(begin);
      return true;
    });
  }
  void keep_what_is_reached(std::span<const UnprovenQuery> unproven);

  const std::vector<tiling::PlannedTile>& tiles_;
  std::int64_t farthest_steps_;
  bool asks_again_;
  tiling::BoxTree cores_;
  std::vector<std::uint32_t>
      waits_for_;  ///< Per tile: tiles around it (itself too) not analysed yet, or kKept. Empty: all are kept.
};

}  // namespace arris::pipeline
