#include "evaluate/plane_comparison.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"

namespace arris::evaluate {

namespace {

bool is_half(std::uint64_t part, std::uint64_t whole) {
  return 2 * part >= whole;
}

std::optional<double> ratio(double part, std::uint64_t whole) {
  if (whole == 0) return std::nullopt;
  return part / static_cast<double>(whole);
}

/// Points of each label but 0, ascending.
std::vector<LabelSize> sizes_of(std::span<const LabelOverlap> overlaps, std::uint32_t LabelOverlap::*label) {
  std::map<std::uint32_t, std::uint64_t> sizes;
  for (const LabelOverlap& overlap : overlaps) {
    if (overlap.*label != 0) sizes[overlap.*label] += overlap.points;
  }
  std::vector<LabelSize> result;
  for (const auto& [number, points] : sizes) result.push_back({number, points});
  return result;
}

const LabelSize& size_in(std::span<const LabelSize> sizes, std::uint32_t label) {
  return *std::lower_bound(sizes.begin(), sizes.end(), label,
                           [](const LabelSize& size, std::uint32_t l) { return size.label < l; });
}

std::vector<LabelSize> not_smaller(std::vector<LabelSize> sizes, double min_points) {
  std::erase_if(sizes, [&](const LabelSize& size) { return static_cast<double>(size.points) < min_points; });
  return sizes;
}

/// Labels and the overlaps between them.
struct Labels {
  std::vector<LabelOverlap> overlaps;  ///< With the labels 0.
  std::vector<LabelSize> planes, segments;
};

std::vector<PlaneMatch> best_segments(const Labels& labels) {
  std::vector<PlaneMatch> matches;
  for (const LabelSize& plane : labels.planes) matches.push_back({plane.label, 0, plane.points, 0, 0});
  for (const LabelOverlap& overlap : labels.overlaps) {
    if (overlap.face == 0 || overlap.segment == 0) continue;
    PlaneMatch& match = *std::lower_bound(matches.begin(), matches.end(), overlap.face,
                                          [](const PlaneMatch& m, std::uint32_t face) { return m.face < face; });
    const std::uint64_t size = size_in(labels.segments, overlap.segment).points;
    const bool better =
        overlap.points > match.common || (overlap.points == match.common && size < match.segment_points);
    if (better) match = {match.face, overlap.segment, match.points, size, overlap.points};
  }
  return matches;
}

/// @param min_points  of planes and segments that are counted.
PlaneFigures figures_of(const Labels& labels, std::span<const PlaneMatch> matches, double min_points) {
  PlaneFigures figures;
  double completeness = 0.0, correctness = 0.0, iou = 0.0;
  std::uint64_t with_segment = 0;
  for (const PlaneMatch& match : matches) {
    if (static_cast<double>(match.points) < min_points) continue;
    ++figures.planes;
    // No other segment has more of the plane.
    if (is_half(match.common, match.points)) ++figures.planes_found;
    completeness += match.completeness();
    iou += match.iou();
    if (const auto correct = match.correctness()) {
      correctness += *correct;
      ++with_segment;
    }
  }
  const std::vector<LabelSize> segments = not_smaller(labels.segments, min_points);
  figures.segments = segments.size();
  std::map<std::uint32_t, std::uint64_t> most;  // Of a segment on one plane.
  for (const LabelOverlap& overlap : labels.overlaps) {
    if (overlap.face != 0) most[overlap.segment] = std::max(most[overlap.segment], overlap.points);
  }
  for (const LabelSize& segment : segments) {
    if (is_half(most[segment.label], segment.points)) ++figures.segments_right;
  }
  figures.found_rate = ratio(static_cast<double>(figures.planes_found), figures.planes);
  figures.right_rate = ratio(static_cast<double>(figures.segments_right), figures.segments);
  const std::uint64_t wrong = figures.segments - figures.segments_right;
  figures.quality = ratio(static_cast<double>(figures.planes_found), figures.planes + wrong);
  figures.completeness = ratio(completeness, figures.planes);
  figures.correctness = ratio(correctness, with_segment);
  figures.iou = ratio(iou, figures.planes);
  figures.relations = relate_planes(labels.overlaps, not_smaller(labels.planes, min_points), segments);
  return figures;
}

}  // namespace

std::optional<double> PlaneMatch::correctness() const {
  return ratio(static_cast<double>(common), segment_points);
}

PlaneComparison compare_planes(std::span<const LabelledPoint> points, const PlaneOptions& options) {
  if (!(options.spacing > 0.0) || !std::isfinite(options.spacing)) {
    throw ConfigError("the point spacing must be above 0; give the spacing");
  }
  if (!(options.min_area >= 0.0) || !std::isfinite(options.min_area)) {
    throw ConfigError("the least area must be at least 0");
  }
  PlaneComparison result;
  result.spacing = options.spacing;
  result.min_area = options.min_area;
  Labels labels;
  labels.overlaps = count_all_overlaps(points);
  labels.planes = sizes_of(labels.overlaps, &LabelOverlap::face);
  labels.segments = sizes_of(labels.overlaps, &LabelOverlap::segment);
  for (const LabelOverlap& overlap : labels.overlaps) {
    (overlap.face != 0 ? result.points : result.strays) += overlap.points;
    if (overlap.segment == 0) {
      (overlap.face != 0 ? result.points_unsegmented : result.strays_unsegmented) += overlap.points;
    }
  }
  result.matches = best_segments(labels);
  result.all = figures_of(labels, result.matches, 0.0);
  result.large = figures_of(labels, result.matches, options.min_area / (options.spacing * options.spacing));
  result.adjusted_rand = measure_overlaps(labels.overlaps).adjusted_rand;
  return result;
}

}  // namespace arris::evaluate
