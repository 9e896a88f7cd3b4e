#pragma once
/// @file One pass over all points as they are stored.

#include <cstddef>
#include <functional>
#include <string_view>

#include "core/cancel.h"
#include "core/progress.h"
#include "io/point_source.h"

namespace arris::pipeline {

/// Reads the inputs from their start and calls use(source, batch) for every batch in turn while the next one is read.
/// Begins a phase of that name. Throws IoError, InputError, Cancelled, and what use() throws.
void for_each_batch(io::InputSet& inputs, const io::ReadOptions& options, std::string_view phase,
                    ProgressSink& progress, const CancelToken& cancel,
                    const std::function<void(std::size_t source, const io::PointBatch& batch)>& use);

}  // namespace arris::pipeline
