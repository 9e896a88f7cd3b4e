#pragma once
/// @file The components that the links of a tile make, and what is told of them.

#include <cstdint>
#include <vector>

#include "core/pages.h"
#include "features/neighbourhood/point_tree.h"
#include "features/segment/query_rings.h"
#include "features/segment/tile_growth.h"
#include "features/segment/tile_links.h"
#include "features/segment/tile_neighbourhoods.h"

namespace arris {

/// Components are numbered from 1 in the order of their first slots; 0: in none. Four bytes per slot.
class TileComponents {
 public:
  /// All arguments must outlive this.
  TileComponents(const PointTree& tree, const TileNeighbourhoods& points, const QueryRings& queries, TileLinks& links);

  std::uint32_t operator[](std::uint32_t slot) const { return component_[slot]; }
  /// Whether a query and all its neighbours are in one component of so many queries or more.
  bool all_around(std::uint32_t slot, std::uint32_t least) const;

  /// Appends sizes and discs, and points that are no queries.
  void measure(TileGrowth& growth);
  /// Appends the queries; needs neither neighbours nor shapes.
  void list(TileGrowth& growth) const;

 private:
  std::uint32_t disc_of(std::uint32_t slot) const;

  const PointTree& tree_;
  const TileNeighbourhoods& points_;
  const QueryRings& queries_;
  const TileLinks& links_;
  PageVector<std::uint32_t> component_;
  std::vector<std::uint32_t> sizes_;  ///< Queries in each.
};

}  // namespace arris
