#pragma once
/// @file Writes every record of the inputs with columns that were worked out for it.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/cancel.h"
#include "core/progress.h"
#include "io/point_source.h"
#include "pipeline/run_support.h"

namespace arris::pipeline {

/// Fills the packed rows of the points [first_id, first_id + count); called for all points in the order of ids, on one
/// thread at a time.
using FillRows = std::function<void(std::uint64_t first_id, std::size_t count, std::vector<std::byte>& rows)>;

/// Reads the inputs once more and appends all points with their rows. Rows are filled and written while the next points
/// are read. Does not commit. Returns the number of points.
std::uint64_t write_columns(io::InputSet& inputs, const FillRows& fill, Writers& writers, ProgressSink& progress,
                            const CancelToken& cancel);

}  // namespace arris::pipeline
