#pragma once
/// @file Neighbours, normals and curvatures of the points of a tile, where they are asked for.

#include <cstdint>
#include <optional>
#include <span>

#include "core/lattice.h"
#include "core/pages.h"
#include "features/neighbourhood/neighbour_search.h"
#include "features/neighbourhood/point_tree.h"
#include "features/segment/neighbour_rows.h"
#include "features/segment/robust_plane.h"
#include "features/segment/segment_parameters.h"

namespace arris {

struct PointShape {
  float nx, ny, nz;  ///< Unit normal, sign free.
  float variation;   ///< sigma_p.
};

/// What is known of a point.
enum class ShapeState : std::uint8_t {
  kUnasked,
  kShaped,    ///< Has a normal.
  kIsolated,  ///< Has none: fewer than 3 neighbours within reach, or all of them on a line with it.
};

/// Points go by their slots in the tree. Memory: NeighbourRows and 22 bytes per slot. Bits of what is found depend on
/// the points within twice the reach and the parameters only. compute() runs in parallel; reading is thread-safe.
class TileNeighbourhoods {
 public:
  /// All arguments must outlive this. What is found is right for points whose ball of reach_of() lies in complete
  /// space.
  TileNeighbourhoods(const PointTree& tree, const Lattice& lattice, const SegmentParameters& parameters);

  /// Computes the slots whose state is kUnasked and whose `wanted` is not 0.
  void compute(std::span<const std::uint8_t> wanted);

  std::size_t size() const { return states_.size(); }
  ShapeState state(std::uint32_t slot) const { return states_[slot]; }
  const PointShape& shape(std::uint32_t slot) const { return shapes_[slot]; }
  /// Gives their memory up: no shape may be asked for any more.
  void forget_shapes() { PageVector<PointShape>().swap(shapes_); }
  /// By (distance, id).
  NeighbourList neighbours(std::uint32_t slot) const { return rows_[slot]; }
  std::size_t count(std::uint32_t slot) const { return rows_.count(slot); }
  /// Calls use(neighbour) in that order until it returns false: cheaper than all of them where that is soon.
  template <class Use>
  void visit_neighbours(std::uint32_t slot, Use&& use) const {
    rows_.visit(slot, use);
  }
  /// Squared distance in steps of the last neighbour; 0: there is none. Of a slot that was asked for.
  std::uint64_t squared_reach(std::uint32_t slot) const {
    const std::uint32_t known = squared_reaches_[slot];
    return known < kFar ? known : squared_distance(tree_.position(slot), tree_.position(rows_.last(slot)));
  }
  /// By the rule and what is in sight; at most that if it is hardly anything. More in sight may make it more.
  std::size_t wanted(std::uint32_t slot) const { return wanted_[slot]; }
  bool full(std::uint32_t slot) const { return count(slot) == wanted(slot); }  ///< As many as wanted.
  /// Distance in steps within which the neighbours must lie, from those found; max_reach_steps() if they are too few.
  double reach_of(std::uint32_t slot) const;
  double max_reach_steps() const { return reach_steps_; }
  /// No reach_of() of those of slots [first, last) that were asked for is more; none: there are none.
  std::optional<double> most_reach(std::size_t first, std::size_t last) const;
  /// The radius of a ball around the point that holds as many others as any point may want; none: they are not in
  /// sight.
  std::optional<double> ball_of_most(std::uint32_t slot) const;

 private:
  class Runner;
  SearchLimits limits(std::size_t k) const;

  static constexpr std::uint32_t kFar = 0xffffffffU;  ///< Of squared_reaches_: as much or more.

  const PointTree& tree_;
  NeighbourRule rule_;
  double reach_steps_;
  PlaneWeights weights_;
  NeighbourRows rows_;
  PageVector<std::uint8_t> wanted_;
  PageVector<PointShape> shapes_;  ///< Where there is one.
  PageVector<ShapeState> states_;
  /// Kept because most are asked for thrice, and the positions of last neighbours lie far apart in memory.
  PageVector<std::uint32_t> squared_reaches_;
};

}  // namespace arris
