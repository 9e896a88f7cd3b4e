#pragma once
/// @file The job of `arris segment`: every point of a scan gets the id of the planar segment it lies in.

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "core/cancel.h"
#include "core/progress.h"
#include "features/segment/segment_parameters.h"
#include "features/segment_contours/segment_contour_parameters.h"
#include "pipeline/intensity_stage.h"
#include "pipeline/run_request.h"
#include "pipeline/tiled_report.h"

namespace arris::pipeline {

struct SegmentRequest : RunRequest {
  SegmentParameters parameters;  ///< max_radius 0: resolved from the survey.
  /// Points lower above the ground (points of class 2) take no part, data units; without: all do.
  std::optional<double> min_height;
  bool contours = false;           ///< Columns EdgeClass, EdgeScore and FoldAngle as well.
  SegmentContourParameters shape;  ///< Of contours and outlines; most_spacing 0: kMostContourSpacings of the survey's.
  std::filesystem::path table;     ///< .csv or .json: a line per segment; empty: not wanted.
  std::filesystem::path outlines;  ///< .gpkg or .obj: polygons; empty: not wanted.
};

/// Segments sampled more sparsely than this many spacings of the scan have contours as if they were sampled so: that
/// bounds how far tiles must look.
constexpr double kMostContourSpacings = 8.0;

struct SegmentReport : TiledReport {
  SegmentParameters parameters;  ///< As used.
  std::optional<double> min_height;
  std::vector<IntensityRange> intensities;  ///< Per input; empty if they played no part.
  SegmentContourParameters shape;
  std::uint64_t segments = 0;
  std::uint64_t boundary = 0, fold = 0;  ///< Points, if asked for.
  std::uint64_t labelled = 0;            ///< Points in a segment.
  std::uint64_t reassigned = 0;          ///< Changes of all sweeps.
  std::uint64_t frontier = 0;            ///< Points near borders of segments, or in none.
};

/// Survey, tiles, growth in each tile, segments of the whole scan, their planes, reassignment, then the inputs again
/// with the column SegmentId (0: none). All points are written. The bytes of the outputs depend on the input points and
/// the parameters only. Outputs appear whole or not at all; temporary files are gone when this returns or throws.
/// Memory beyond the tiles: 4 bytes per point of the scan. Throws the errors of core/error.h.
SegmentReport segment(const SegmentRequest& request, ProgressSink& progress, const CancelToken& cancel);

/// Everything up to the plan of the tiles; --contours and outlines, which plan tiles of their own, are left out. Reads
/// the inputs, writes nothing.
SegmentReport plan_segments(const SegmentRequest& request, ProgressSink& progress, const CancelToken& cancel);

nlohmann::ordered_json to_json(const SegmentReport& report);
nlohmann::ordered_json segment_json(const SegmentParameters& parameters);

}  // namespace arris::pipeline
