#pragma once
/// @file How well supervoxels or segments of a cloud agree with the true surfaces of its points.
///
/// Points on no surface (face 0) and points without finite coordinates are left out altogether, but for planes
/// (plane_comparison.h), where points on no surface count. Points without a
/// segment (segment 0) count as such, and for boundaries form a region of their own; the overlaps are of the others. So
/// a segmentation that leaves much out must be judged by `unsegmented` too.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "evaluate/boundary_recall.h"
#include "evaluate/label_overlaps.h"
#include "evaluate/labelled_point.h"
#include "evaluate/plane_comparison.h"

namespace arris::evaluate {

/// Column of clouds with known truth, as `arris synth --labels` writes it.
inline constexpr std::string_view kFaceColumn = "FaceId";

struct SegmentationOptions {
  double spacing = 0.0;  ///< s, > 0, data units.
  double radius = 0.0;   ///< A point is a boundary point if one of another label is so near; 0: 2 s.
  double voxel =
      0.0;  ///< Size R of the voxels that supervoxels were made of; 0: unknown. Adds the tolerance R sqrt(3).
  std::vector<double> tolerance_factors{1.0, 2.0, 3.0};  ///< In spacings, each > 0.
  std::optional<double> min_plane_area{};                ///< Given: planes are judged too, see PlaneOptions.
};

struct SegmentationComparison {
  double spacing = 0.0;
  double radius = 0.0;
  std::uint64_t judged = 0;       ///< Points that count.
  std::uint64_t left_out = 0;     ///< On no surface, or without a position.
  std::uint64_t unsegmented = 0;  ///< Of those judged.
  OverlapMeasures overlaps;
  std::optional<double> points_per_segment;  ///< Mean.
  std::optional<double> compactness;         ///< See segment_shapes.h.
  std::uint64_t truth_boundary = 0;          ///< Boundary points of the truth.
  std::uint64_t segment_boundary = 0;
  std::vector<BoundaryAgreement> boundaries;  ///< By ascending tolerance.
  std::optional<PlaneComparison> planes;      ///< If asked for.
};

/// O(n log n) for n points; about 40 bytes per point besides the points. Runs in parallel; the result depends neither
/// on the number of threads nor on the numbers that segments and faces have. Throws ConfigError for invalid options.
SegmentationComparison compare_segmentation(std::span<const LabelledPoint> points, const SegmentationOptions& options);

}  // namespace arris::evaluate
