#pragma once
/// @file How well planes (roofs, facades) are found: by plane, by segment, and by point.
///
/// All points with finite coordinates count: |t| are the points of the true plane t, |s| those of the segment s,
/// |s ∩ t| those of both. Points on no surface (face 0: trees, stray points) belong to no plane, but to |s|: a segment
/// that takes them is less correct for it. Points without a segment belong to |t|: a plane that loses them is less
/// complete.
///
/// Rules, all on numbers of points, after Rutzinger et al. 2009 (theirs are on areas of a label image):
/// * t is found if one segment has at least half of it: |s ∩ t| >= |t| / 2 for some s.
/// * s is right if at least half of it is on one plane: |s ∩ t| >= |s| / 2 for some t.
/// * The best segment of t is the one with the most of its points; of equals the smaller one.
/// * s and t belong together if one of them has at least half of the other; see plane_relations.h.
/// The area of a plane or segment is its number of points times the spacing squared. Planes are judged against all
/// segments and segments against all planes, also where only those of a least area are counted.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "evaluate/label_overlaps.h"
#include "evaluate/labelled_point.h"
#include "evaluate/plane_relations.h"

namespace arris::evaluate {

struct PlaneOptions {
  double spacing = 0.0;    ///< s, > 0, data units: points per area are 1 / s².
  double min_area = 10.0;  ///< >= 0, data units squared: the least area of what counts as large.
};

/// One true plane and its best segment.
struct PlaneMatch {
  std::uint32_t face = 0;
  std::uint32_t segment = 0;         ///< The best one; 0: no point of the plane has a segment.
  std::uint64_t points = 0;          ///< |t|.
  std::uint64_t segment_points = 0;  ///< |s|.
  std::uint64_t common = 0;          ///< |s ∩ t|.

  double completeness() const { return static_cast<double>(common) / static_cast<double>(points); }
  /// Undefined without a segment.
  std::optional<double> correctness() const;
  double iou() const { return static_cast<double>(common) / static_cast<double>(points + segment_points - common); }
};

/// Figures of the planes and segments of at least some area.
struct PlaneFigures {
  std::uint64_t planes = 0, planes_found = 0;
  std::uint64_t segments = 0, segments_right = 0;
  /// Rates of the above.
  std::optional<double> found_rate, right_rate;
  /// found / (planes + wrong segments): quality after Rutzinger.
  std::optional<double> quality;
  /// Means over the planes of |s ∩ t| / |t|, |s ∩ t| / |s| and |s ∩ t| / |s ∪ t| with the best segment s; the second
  /// over those that have one.
  std::optional<double> completeness, correctness, iou;
  PlaneRelations relations;
};

struct PlaneComparison {
  double spacing = 0.0, min_area = 0.0;
  std::uint64_t points = 0;  ///< Of planes, with a segment or without.
  std::uint64_t points_unsegmented = 0;
  std::uint64_t strays = 0;  ///< Points on no surface.
  std::uint64_t strays_unsegmented = 0;
  PlaneFigures all, large;
  /// Over all points; those on no surface are a face and those without a segment a segment of their own.
  std::optional<double> adjusted_rand;
  std::vector<PlaneMatch> matches;  ///< Of every true plane, ascending by face.
};

/// O(n log n), 8 bytes per point. The result depends on the numbers of faces and segments only where `matches` names
/// them. Throws ConfigError for invalid options.
PlaneComparison compare_planes(std::span<const LabelledPoint> points, const PlaneOptions& options);

}  // namespace arris::evaluate
