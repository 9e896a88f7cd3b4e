#pragma once
/// @file Writes every record of the inputs with a label that was worked out for it.

#include <cstdint>

#include "core/cancel.h"
#include "core/progress.h"
#include "io/point_source.h"
#include "merge/point_labels.h"
#include "pipeline/run_support.h"

namespace arris::pipeline {

/// Reads the inputs once more and appends all points, each with its label as one uint32 column. With more than one
/// thread in parallel.h's limit, writing goes on while the next points are read. Does not commit. Returns the number of
/// points.
std::uint64_t write_column(io::InputSet& inputs, const merge::PointLabels& labels, Writers& writers,
                           ProgressSink& progress, const CancelToken& cancel);

}  // namespace arris::pipeline
