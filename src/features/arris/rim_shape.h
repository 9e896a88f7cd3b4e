#pragma once
/// @file How the surface that holds a point ends around it: the evidence for boundaries.

#include <vector>

#include "features/arris/azimuth_spread.h"
#include "features/arris/layer_view.h"
#include "features/arris/own_layer.h"
#include "features/arris/planar_hull.h"

namespace arris {

/// Lengths in spacings.
struct RimShape {
  double gap_deg = 0.0;  ///< Largest azimuth gap of the layer's points seen along its normal.
  double depth = 0.0;    ///< Distance from the point to the convex hull of the layer's points around it; 0 outside.
  double empty_radius = 0.0;  ///< Of the largest disc without points whose border touches the point.
  double opposite = 0.0;      ///< Points within 3 on the other side than the empty disc, within 60 degrees.
  double count = 0.0;         ///< Azimuths.
  double inner_share =
      0;  ///< Of the layer's points, those in the inner half of the gate: 0.5 for a cloud, 0.87 for noise.
  double beyond_share = 0;  ///< Points between one and two gates from the plane, over those within: about 1 in a cloud.
  double offset = 0.0;      ///< Distance of the point to the layer's plane.
  double gate = 0.0;        ///< Points farther from the plane belong to something else.
  double rms = 0.0;         ///< Of the layer's points about its plane.
  double width = 0.0;       ///< Spread of the layer across its longest direction: near 0 for strings of points.
  Vector3 direction{1, 0, 0};  ///< Unit: of the side of the hull that is nearest.
  Vector3 nearest{0, 0, 0};  ///< The point of the hull that is nearest to the centre: the rim as far as it is sampled.
};

/// Reusable memory, and what look_for_gap() leaves for measure_beside_gap().
struct RimScratch {
  FittedPlane plane;
  LayerView view;
  std::vector<double> u, v;  ///< Of the points of the layer that have an azimuth.
  std::vector<Planar> seen, inverted;
  AzimuthScratch azimuths;
  HullScratch hull;
  LayerScratch layer;
};

/// The layer is found from the point outwards: a plane through its nearest neighbours, then refits on growing discs
/// with the points farther than max(0.8, 3 noise) left out; two layers 2 spacings apart do not mix. Law: bits depend on
/// the set of points only. O(n log n) in the layer's points.
/// @param radius  of the disc that is judged, at most the ball's.
/// @param noise   standard deviation of the points about their surface.
/// Where neither the disc nor its inner 3 spacings may have a gap of 105 degrees, all but count, rms and width is left
/// at 0.
RimShape measure_rim(const BallPoints& points, double radius, double noise, RimScratch& scratch);

/// The first half of measure_rim(), which most points need no more than: all that hulls and empty discs do not say.
/// gap_deg is 0 where there is no gap.
RimShape look_for_gap(const BallPoints& points, double radius, double noise, RimScratch& scratch);
/// The second half, of the same points: depth, empty_radius, opposite, direction and nearest. Needs gap_deg > 0.
void measure_beside_gap(RimScratch& scratch, RimShape& shape);

}  // namespace arris
