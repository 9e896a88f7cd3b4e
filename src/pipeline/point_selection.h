#pragma once
/// @file Which points of the inputs take part in a job.

#include "io/point_source.h"
#include "pipeline/run_request.h"
#include "tiling/survey.h"

namespace arris::pipeline {

/// Throws InputError if classes were asked for (PointExclusion::only_classes) and the survey found points, but not one
/// of these classes that takes part: a mistyped class must not look like a scan without contours.
void refuse_missing_classes(const RunRequest& request, const tiling::Survey& survey);

}  // namespace arris::pipeline
