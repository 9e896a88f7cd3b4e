#include "segment_filter_options.h"

#include <CLI/CLI.hpp>

#include "run_options.h"

namespace arris::tools {

double SegmentFilterOptions::min_height_units() const {
  return length_or(min_height, 0.0);
}

void add_segment_filter_options(CLI::App& verb, SegmentFilterOptions& o, const std::string& group) {
  verb.add_option("--min-height", o.min_height,
                  "Only points at least this high above the ground take part (length; needs ground points, class 2)")
      ->group(group);
  verb.add_flag("--no-intensity", o.no_intensity, "Intensities play no part")->group(group);
}

}  // namespace arris::tools
