#pragma once
/// @file Whether all that a point's growth depends on was seen.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "core/pages.h"
#include "features/neighbourhood/point_tree.h"
#include "features/segment/tile_neighbourhoods.h"

namespace arris {

/// The support of a query is the balls that hold its neighbours, their neighbours, and so on for `rings` rings. Found
/// neighbours bound where the true ones are: they cannot be farther.
class SupportProof {
 public:
  SupportProof(const PointTree& tree, const TileNeighbourhoods& points, int rings)
      : tree_(tree), points_(points), rings_(rings) {}

  /// Queries whose support is not inside of `covered`, ascending. O(points).
  std::vector<std::uint32_t> unproven(std::span<const std::uint8_t> is_query, const LatticeBox& covered) const;

  /// How far around a slot space is known, steps: no unseen position is nearer.
  using Depth = std::function<double(std::uint32_t slot)>;
  /// 0 if the support of the query lies in known space. Else how far around it space must be known to see the first
  /// ring that is not, steps: more than now. Repeated, that ends after a few rounds, because no neighbour's ball is
  /// larger than the distance to it and the radius of the ball around the point itself together.
  double reach(std::uint32_t slot, const Depth& depth) const;
  Depth depth_in(const LatticeBox& covered) const;
  /// Where space is known within `radius` around a slot.
  Depth depth_around(std::uint32_t slot, double radius) const;

  /// Of a query, whatever more of the scan is in sight: once the first ball of this radius is, no reach() is greater
  /// than the second. None: too few points are in sight to tell.
  struct Bound {
    double first = 0.0, most = 0.0;
  };
  std::optional<Bound> bound(std::uint32_t slot) const;

 private:
  class BadSlots;
  double distance(std::uint32_t a, std::uint32_t b) const;

  const PointTree& tree_;
  const TileNeighbourhoods& points_;
  int rings_;
};

}  // namespace arris
