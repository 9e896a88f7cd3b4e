#pragma once
/// @file Pass 3: reads the inputs again, in order, and writes the kept records with our columns.

#include <vector>

#include "core/cancel.h"
#include "core/progress.h"
#include "io/point_source.h"
#include "io/point_writer.h"
#include "merge/result_spool.h"
#include "pipeline/extract.h"

namespace arris::pipeline {

/// Streams inputs and results side by side in the order of ids and appends to every writer; counts into `report`. Does
/// not commit.
void gather_points(io::InputSet& inputs, const ExtractRequest& request, const ContourParameters& method,
                   merge::ResultSpool& results, std::vector<std::unique_ptr<io::KeptPointWriter>>& writers,
                   ExtractReport& report, ProgressSink& progress, const CancelToken& cancel);

}  // namespace arris::pipeline
