#pragma once
/// @file Where planar segments end and where they meet, and the edges of their outlines.
///
/// A point of a segment is a fold point if it is near the line in which the segment's plane meets another one at an
/// angle, and points of both segments are near that place: planes that would meet farther off, as at steps, make no
/// fold. It is a boundary point if it is exposed (alpha_exposed.h) in the plane of its segment, still is together with
/// the segments that continue the surface (at less than the fold angle), and no fold is near. Points outside of the
/// slab around their plane that the shape is made of are no boundary points, and points without a segment are nothing.
///
/// EdgeScore: of folds the nearness to the line, the angle in units of twice the least one, and the support; of
/// boundaries the free directions as a share of those that a straight border shows.

#include <cstdint>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "core/tile_points.h"
#include "features/contour/contour_record.h"
#include "features/segment_contours/outline_edge.h"
#include "features/segment_contours/segment_contour_parameters.h"

namespace arris {

struct SegmentContours {
  /// Contour points in the tile's core, duplicates expanded, ascending ids. EdgeClass: kFold (with kConvex or
  /// kConcave), or kBoundary. to_edge of folds: to the line in which the planes meet.
  ContourRecords records;
  std::vector<OutlineEdge> edges;  ///< Those whose `from` is in the core; ascending.
};

/// @param labels  segment per entry of tile.positions, 0: none; no label is greater than planes.size().
/// The tile must be covered segment_contour_halo() around its core. Runs in parallel; bits depend on points, labels,
/// planes and parameters only. About a microsecond a point. Throws ConfigError as validate().
SegmentContours analyse_segment_contours(const TilePoints& tile, std::span<const std::uint32_t> labels,
                                         std::span<const SegmentPlane> planes, const Lattice& lattice,
                                         const SegmentContourParameters& parameters);

extern const double kSegmentContourBytesPerPoint;  ///< Beyond the tile and the labels.
extern const double kSegmentContourBytesPerThread;

}  // namespace arris
