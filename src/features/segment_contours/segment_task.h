#pragma once
/// @file What the analysis of a tile's segments shares.

#include <cstdint>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "features/neighbourhood/point_tree.h"
#include "features/planar/labelled_group.h"
#include "features/segment_contours/segment_contour_parameters.h"

namespace arris {

/// One tile. Read only.
struct SegmentTask {
  const PointTree& tree;
  std::span<const std::uint32_t> labels;  ///< In the tree's order.
  std::span<const SegmentPlane> planes;
  const Lattice& lattice;
  const SegmentContourParameters& parameters;

  const SegmentPlane& plane(std::uint32_t label) const { return planes[label - 1]; }
  SegmentLengths lengths(std::uint32_t label) const { return segment_lengths(plane(label), lattice, parameters); }
  /// Of the point in a slot from the plane of a segment, steps; a function of the position, whatever the tile.
  double distance(std::uint32_t label, std::uint32_t slot) const {
    return signed_distance(plane(label), tree.position(slot));
  }
};

}  // namespace arris
