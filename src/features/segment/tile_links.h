#pragma once
/// @file Which points of a tile are linked with each other.

#include <cstdint>
#include <span>
#include <vector>

#include "core/disjoint_sets.h"
#include "core/pages.h"
#include "features/segment/likeness.h"
#include "features/segment/query_rings.h"
#include "features/segment/tile_neighbourhoods.h"

namespace arris {

/// The links of the queries, as sets of slots, found in parallel; tile_growth.h tells what a link is. Six bytes per
/// slot.
class TileLinks {
 public:
  /// A point that cannot grow and would join the set of one that does.
  struct Offer {
    std::uint32_t joins;
    std::uint32_t via;
  };

  /// @param grows   per slot.
  /// @param offers  whether they are asked for.
  TileLinks(const TileNeighbourhoods& points, const QueryRings& rings, const Likeness& likeness,
            std::span<const std::uint8_t> grows, bool offers);

  /// It has a link or makes an offer.
  bool numbered(std::uint32_t slot) const { return numbered_[slot] != 0; }
  /// The smallest slot of its set.
  std::uint32_t root(std::uint32_t slot) { return sets_.find(slot); }
  /// Every neighbour was seen to be in the same set; of queries.
  bool among_own(std::uint32_t slot) const { return among_own_[slot] != 0; }
  const std::vector<Offer>& offers() const { return offers_; }
  std::uint64_t isolated() const { return isolated_; }  ///< Queries without a normal.

 private:
  /// What a stretch of slots yields besides the sets.
  struct Part {
    std::vector<Offer> offers;
    std::uint64_t isolated = 0;
  };
  void link(std::uint32_t slot, Part& part);
  void number(std::uint32_t slot);
  void join(std::uint32_t a, std::uint32_t b);
  bool all_below(std::uint32_t root, const NeighbourList& neighbours) const;
  bool alike(std::uint32_t slot, std::uint32_t neighbour) const {
    return points_.state(neighbour) == ShapeState::kShaped && likeness_.alike(slot, neighbour);
  }

  const TileNeighbourhoods& points_;
  const Likeness& likeness_;
  std::span<const std::uint8_t> grows_;
  bool makes_offers_;
  DisjointSets sets_;
  PageVector<std::uint8_t> numbered_;
  PageVector<std::uint8_t> among_own_;
  std::vector<Offer> offers_;
  std::uint64_t isolated_ = 0;
};

}  // namespace arris
