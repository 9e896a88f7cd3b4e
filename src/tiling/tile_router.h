#pragma once
/// @file Which tiles want a point.

#include <array>
#include <cstdint>
#include <vector>

#include "core/lattice.h"
#include "tiling/box_tree.h"
#include "tiling/tile_plan.h"

namespace arris::tiling {

/// Finds the tiles whose covered box holds a point. Every look-up also yields a box around the point in which the
/// answer stays the same; the last few are kept, so that coherent input needs six comparisons per point. Not
/// thread-safe.
class TileRouter {
 public:
  /// The answer for every position in `region`: indices of tiles, ascending.
  struct Route {
    LatticeBox region;
    std::vector<std::uint32_t> tiles;
  };

  explicit TileRouter(const TilePlan& plan);
  /// The reference is valid until the next call.
  const Route& route(const LatticePoint& p);
  /// Appends the tiles whose covered box intersects `box`, ascending.
  void touching(const LatticeBox& box, std::vector<std::uint32_t>& tiles) const;

 private:
  void look_up(const LatticePoint& p, Route& route) const;

  BoxTree tree_;
  std::array<Route, 8> recent_;
  std::size_t current_ = 0;
  std::size_t oldest_ = 0;
};

}  // namespace arris::tiling
