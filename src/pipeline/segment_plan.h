#pragma once
/// @file Everything about segments that is decided before a point is moved.

#include "io/point_source.h"
#include "pipeline/run_support.h"
#include "pipeline/segment.h"
#include "pipeline/tile_job.h"

namespace arris::pipeline {

struct SegmentPlan {
  IntensityTable intensities;  ///< Empty if they play no part.
  TileJob job;
};

/// Which points take part, survey, number of neighbours, tiles: resolves report.parameters, which are the request's at
/// first, and tells the report. Throws BudgetError if memory or disk cannot do.
SegmentPlan plan_segment_job(io::InputSet& inputs, const SegmentRequest& request, ProblemWarnings& problems,
                             SegmentReport& report, Stopwatch& watch, ProgressSink& progress,
                             const CancelToken& cancel);

}  // namespace arris::pipeline
