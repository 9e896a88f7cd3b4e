#pragma once
/// @file Which points of a tile are asked about, and the rings of neighbours around them.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/lattice.h"
#include "core/pages.h"
#include "features/contour/tile_contours.h"
#include "features/neighbourhood/point_tree.h"
#include "features/segment/tile_neighbourhoods.h"

namespace arris {

/// Points go by their slots in the tree. Ring 0 are the queries, ring 1 their neighbours that are none, and so on. Two
/// bytes per slot.
class QueryRings {
 public:
  /// The queries are the points in the core.
  QueryRings(const PointTree& tree, const LatticeBox& core);
  /// They are the entries listed.
  QueryRings(const PointTree& tree, std::span<const PlacedQuery> queries);

  /// Computes the neighbourhoods of the queries and of so many rings around them. In parallel.
  void compute(TileNeighbourhoods& points, int rings);

  bool is_query(std::uint32_t slot) const { return is_query_[slot] != 0; }
  std::span<const std::uint8_t> are_queries() const { return is_query_; }
  /// It is none from here on, but stays in its ring.
  void leave(std::uint32_t slot) { is_query_[slot] = 0; }
  /// In the ring or in one inside it.
  bool within(std::uint32_t slot, std::uint8_t ring) const { return ring_[slot] <= ring; }
  /// Slot and reach of queries that were listed.
  std::span<const std::pair<std::uint32_t, std::int64_t>> listed() const { return listed_; }

  template <class Use>
  void for_each_query(Use&& use) const {
    for (std::uint32_t slot = 0; slot < is_query_.size(); ++slot)
      if (is_query_[slot]) use(slot);
  }

 private:
  static constexpr std::uint8_t kNoRing = 255;
  bool mark_neighbours(const TileNeighbourhoods& points, std::uint8_t ring);
  bool all_queries_around(const TileNeighbourhoods& points, std::uint32_t slot) const;

  const PointTree& tree_;
  LatticeBox whole_;  ///< Every point in here is a query.
  PageVector<std::uint8_t> is_query_;
  PageVector<std::uint8_t> ring_;
  std::vector<std::pair<std::uint32_t, std::int64_t>> listed_;
};

}  // namespace arris
