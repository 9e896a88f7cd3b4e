#pragma once
/// @file The main job: contour points of scans of any size, in a memory budget. This is the library's front door.

#include "core/cancel.h"
#include "core/progress.h"
#include "features/contour/contour_method.h"
#include "pipeline/extract_report.h"
#include "pipeline/run_request.h"

namespace arris::pipeline {

struct ExtractRequest : RunRequest {
  ContourParameters method;  ///< max_radius 0: resolved from the survey.
  bool keep_all = false;     ///< Write every point, not only contour points (also excluded ones).
  bool refined = false;      ///< Add the columns EdgeX, EdgeY, EdgeZ (method arris).
};

/// Runs the job: survey, plan, partition, tiles, widening, gather and write (docs/architecture.md). The bytes of the
/// outputs depend on the input points and the parameters only. Outputs appear whole or not at all; temporary files are
/// gone when this returns or throws. Throws the errors of core/error.h.
ExtractReport extract(const ExtractRequest& request, ProgressSink& progress, const CancelToken& cancel);

/// Everything up to the plan: reads the inputs, writes nothing.
ExtractReport plan_only(const ExtractRequest& request, ProgressSink& progress, const CancelToken& cancel);

}  // namespace arris::pipeline
