#pragma once
/// @file Options of the verbs that run or plan the job of segments.

#include "pipeline/segment.h"
#include "run_options.h"
#include "segment_filter_options.h"
#include "segment_options.h"

namespace CLI {
class App;
}

namespace arris::tools {

/// As typed; to_request() turns it into a checked request without outputs.
struct SegmentJobOptions {
  RunOptions run;
  SegmentOptions segment;
  SegmentFilterOptions filter;
};

void add_segment_job_options(CLI::App& verb, SegmentJobOptions& options);
pipeline::SegmentRequest to_request(SegmentJobOptions& options);

}  // namespace arris::tools
