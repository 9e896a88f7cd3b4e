#pragma once
/// @file Parameters of the contours and outlines of planar segments, and how far they look.

#include <cstdint>
#include <span>

#include "core/lattice.h"
#include "features/arris/arris_parameters.h"
#include "features/segment/segment_plane.h"

namespace arris {

/// Lengths are multiples of a segment's own spacing s.
struct SegmentContourParameters {
  double alpha_factor = 2.0;     ///< Radius of the alpha shape, >= 1.
  double fold_angle_deg = 15.0;  ///< Planes that meet at a smaller angle make no fold, (0, 90).
  double line_factor = 1.0;      ///< Fold points lie this near to the line in which the planes meet ...
  double support_factor = 2.0;   ///< ... and points of both segments this near to that place on the line.
  /// Data units: segments that are sampled more sparsely are looked at as if this was their spacing; that bounds the
  /// halo. 0: no limit.
  double most_spacing = 0.0;
  bool boundary = true;                                        ///< Find where segments end.
  bool fold = true;                                            ///< Find where segments meet.
  bool outlines = true;                                        ///< Give the edges of outlines.
  ArrisParameters::View view = ArrisParameters::View::kAbove;  ///< From where convex and concave are told apart.
  std::array<double, 3> viewpoint{0.0, 0.0, 0.0};              ///< For View::kPoint: world coordinates.
};

/// Throws ConfigError, naming the option, if a value is out of range.
void validate(const SegmentContourParameters& parameters);

/// Lengths that hold for one segment, steps.
struct SegmentLengths {
  double spacing = 0.0;       ///< At most most_spacing.
  double two_alpha = 0.0;     ///< A multiple of 2^-kFrameBits.
  double slab = 0.0;          ///< Points farther from the plane are no part of the shape.
  double line = 0.0;          ///< Fold points are no farther from the line of their fold.
  double explain = 0.0;       ///< A fold this near explains that the segment ends.
  double support = 0.0;       ///< Points of the segment that support a fold are this near to its place.
  double most_support = 0.0;  ///< Points of the other segment, however sparse, are this near.
  double reach = 0.0;         ///< Nothing farther from a point of the segment matters to it.
};

SegmentLengths segment_lengths(const SegmentPlane& plane, const Lattice& lattice,
                               const SegmentContourParameters& parameters);

/// Support radius in data units: what is said of a point depends on points (and their labels) within this distance
/// only, and on the planes. The tile must be covered this far around its core; every query is then complete.
/// About 6 s of the sparsest segment by default. Throws ConfigError if it exceeds 2^26 lattice steps. O(planes).
double segment_contour_halo(const SegmentContourParameters& parameters, std::span<const SegmentPlane> planes,
                            const Lattice& lattice);

}  // namespace arris
