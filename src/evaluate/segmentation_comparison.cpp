#include "evaluate/segmentation_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "evaluate/evaluation_setup.h"
#include "evaluate/label_boundary.h"
#include "evaluate/segment_shapes.h"

namespace arris::evaluate {

namespace {

std::vector<double> tolerances_of(const SegmentationOptions& options) {
  if (!(options.spacing > 0.0) || !std::isfinite(options.spacing)) {
    throw ConfigError("the point spacing must be above 0; give the spacing");
  }
  if (!(options.voxel >= 0.0) || !std::isfinite(options.voxel)) throw ConfigError("the voxel size must be at least 0");
  if (!(options.radius >= 0.0)) throw ConfigError("the radius of boundary points must be at least 0");
  std::vector<double> tolerances;
  for (const double factor : options.tolerance_factors) {
    if (!(factor > 0.0) || !std::isfinite(factor))
      throw ConfigError(fmt::format("tolerance factor {} must be above 0", factor));
    tolerances.push_back(factor * options.spacing);
  }
  if (options.voxel > 0.0) tolerances.push_back(options.voxel * std::numbers::sqrt3);
  std::sort(tolerances.begin(), tolerances.end());
  const auto same = [](double a, double b) { return b - a <= kToleranceSlack * b; };
  tolerances.erase(std::unique(tolerances.begin(), tolerances.end(), same), tolerances.end());
  return tolerances;
}

}  // namespace

SegmentationComparison compare_segmentation(std::span<const LabelledPoint> points, const SegmentationOptions& options) {
  const std::vector<double> tolerances = tolerances_of(options);
  if (points.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw ConfigError("segmentations of more than 4 billion points cannot be judged; take a part of the cloud");
  }
  SegmentationComparison result;
  result.spacing = options.spacing;
  result.radius = options.radius > 0.0 ? options.radius : 2.0 * options.spacing;
  for (const LabelledPoint& p : points) {
    const bool judged = is_judged(p);
    ++(judged ? result.judged : result.left_out);
    if (judged && p.segment == 0) ++result.unsegmented;
  }
  result.overlaps = measure_overlaps(count_overlaps(points));
  if (result.overlaps.segments > 0) {
    result.points_per_segment =
        static_cast<double>(result.overlaps.points) / static_cast<double>(result.overlaps.segments);
  }
  result.compactness = mean_compactness(points);
  const auto truth = find_label_boundary(points, &LabelledPoint::face, result.radius);
  const auto segments = find_label_boundary(points, &LabelledPoint::segment, result.radius);
  result.truth_boundary = truth.size();
  result.segment_boundary = segments.size();
  result.boundaries = compare_boundaries(points, truth, segments, tolerances);
  if (options.min_plane_area) result.planes = compare_planes(points, {options.spacing, *options.min_plane_area});
  return result;
}

}  // namespace arris::evaluate
