#pragma once
/// @file The part of arris evaluate that judges supervoxels and segments.

#include <string>

#include "session.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace arris::tools {

struct SegmentsOptions {
  std::string truth;             ///< Cloud with the column of faces; empty: segments are not judged.
  std::string segments;          ///< Column of the prediction; empty: SupervoxelId or SegmentId.
  std::string faces = "FaceId";  ///< Column of the truth.
  std::string radius, voxel;     ///< Lengths; empty: not given.
  bool planes = false;           ///< Judge planes too; columns SegmentId are judged so anyway.
  double min_area = 10.0;        ///< Of planes that count as large.
};

/// Declares the options and returns --labels, which asks for this judgement.
CLI::Option* add_segments_options(CLI::App& verb, SegmentsOptions& options);

/// How the result is printed.
enum class ResultFormat { kTable, kJson, kCsv };

/// @param spacing  a length; empty: estimated from the truth's points. Returns the exit code.
int evaluate_segments(const std::string& prediction, const SegmentsOptions& options, const std::string& spacing,
                      ResultFormat format, Session& session);

}  // namespace arris::tools
