#include "segment_job_options.h"

#include <CLI/CLI.hpp>

namespace arris::tools {

void add_segment_job_options(CLI::App& verb, SegmentJobOptions& o) {
  add_run_options(verb, o.run);
  add_segment_options(verb, o.segment);
  add_segment_filter_options(verb, o.filter, "Points that take part");
}

pipeline::SegmentRequest to_request(SegmentJobOptions& o) {
  pipeline::SegmentRequest request;
  fill_run_request(o.run, request);
  request.parameters = to_parameters(o.segment);
  request.parameters.intensity = !o.filter.no_intensity;
  request.contours = o.segment.contours;
  request.shape = o.segment.shape;
  if (o.filter.by_height()) request.min_height = o.filter.min_height_units();
  return request;
}

}  // namespace arris::tools
