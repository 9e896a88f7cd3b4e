#pragma once
/// @file Options of region growing.

#include <string>

#include "features/segment/segment_parameters.h"

namespace CLI {
class App;
}

namespace arris::tools {

struct SegmentOptions {
  SegmentParameters parameters;
  std::string radius, max_radius, inlier_distance, reassign_distance;  ///< Lengths.
};

void add_segment_options(CLI::App& verb, SegmentOptions& options);
/// Throws ConfigError for lengths that are none.
SegmentParameters to_parameters(const SegmentOptions& options);

}  // namespace arris::tools
