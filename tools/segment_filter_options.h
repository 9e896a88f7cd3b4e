#pragma once
/// @file Options for what is done to points before segments are sought.

#include <string>

namespace CLI {
class App;
}

namespace arris::tools {

/// As typed.
struct SegmentFilterOptions {
  std::string min_height;  ///< Length with a unit.
  bool no_intensity = false;

  bool by_height() const { return !min_height.empty(); }
  /// Data units; 0 if nothing was typed. Throws ConfigError.
  double min_height_units() const;
};

/// @param group  under which the help lists them.
void add_segment_filter_options(CLI::App& verb, SegmentFilterOptions& options, const std::string& group);

}  // namespace arris::tools
