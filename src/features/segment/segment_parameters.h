#pragma once
/// @file Parameters of planar segments by region growing (Yu et al.).

#include <cstddef>
#include <cstdint>
#include <optional>

#include "features/segment/neighbour_rule.h"

namespace arris {

/// Lengths in data units. Defaults are the paper's where it gives a value.
struct SegmentParameters {
  /// k, 3 to kMostNeighbours; without: 8 as published, else by the rule of noise below.
  std::optional<std::size_t> neighbours;
  /// Of the scan, in data units, and the most neighbours that it gives a point (neighbour_rule.h). Resolved by the
  /// pipeline; 0: 8 neighbours everywhere.
  double noise = 0.0;
  std::size_t most_by_noise = kFewestNeighbours;
  /// > 0: the neighbours are all points this near, but no more than kMostNeighbours, instead of the k nearest.
  double radius = 0.0;
  double max_radius = 0.0;  ///< R_max: no neighbour is farther, > 0 when the method runs (resolved by the pipeline).
  double inlier_distance = 0.0;  ///< d_max of the robust plane; 0: from the residuals (robust_plane.h).
  double angle_deg = 7.2;        ///< 0.04 pi: normals of neighbours in one segment differ by less, (0, 90).
  /// Intensities (0 to 255) of neighbours in one segment differ by less, >= 1; without: 10 as published, where they are
  /// those of the points, else 20, where they are medians of each point's surroundings.
  std::optional<int> intensity_step;
  bool intensity = true;          ///< Compare intensities, where the points have them.
  double curvature = 0.2;         ///< Segments grow from points with a smaller sigma_p, (0, 1/3 and a little].
  std::uint32_t min_points = 20;  ///< Smaller segments are none, >= 1.
  /// Not as published: segments grow only from points that at least this share of their neighbours is like, [0, 1].
  std::optional<double> agreement;  ///< Without: 0.3.
  std::optional<int> sweeps;        ///< Of the reassignment, 0 to 10; without: 2 as published, else 4.
  /// d_re: points farther from a segment's plane are not given to it; 0: max(3 RMS, kLeastReassign), at most
  /// kMostReassign, in spacings of the segment.
  double reassign_distance = 0.0;
  /// As published. Else also: segments grow only from points most of whose neighbours lie in their plane, and points
  /// near the border of a segment go to the nearest of the planes around, whether they had a segment or not.
  bool published = false;

  /// Searches stop here: radius if given, else R_max.
  double reach() const { return radius > 0.0 && radius < max_radius ? radius : max_radius; }
  /// The number follows the noise.
  bool adaptive() const { return !neighbours && radius <= 0.0 && !published; }
  std::size_t most_neighbours() const;
  double least_agreement() const { return published ? 0.0 : agreement.value_or(0.3); }
  int least_intensity_step() const { return intensity_step.value_or(published ? 10 : 20); }
  int sweep_count() const { return sweeps.value_or(published ? 2 : 4); }
  /// Smaller components are dropped before the reassignment. Not as published segments then gain the points that they
  /// could not grow to, so fewer do, and min_points is asked afterwards.
  std::uint32_t least_component() const { return published ? min_points : (min_points + 1) / 2; }
};

/// Throws ConfigError, naming the option, if a value is out of range.
void validate(const SegmentParameters& parameters);

/// @param step  of the lattice.
NeighbourRule neighbour_rule(const SegmentParameters& parameters, double step);

/// A halo, in data units, that proves nearly all queries where the spacing is at most `spacing`.
double segment_halo(const SegmentParameters& parameters, double spacing);

}  // namespace arris
