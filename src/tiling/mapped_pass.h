#pragma once
/// @file One pass over all points as lattice points.

#include <functional>
#include <span>
#include <string_view>

#include "core/cancel.h"
#include "core/lattice.h"
#include "core/progress.h"
#include "io/point_source.h"
#include "tiling/lattice_mapper.h"

namespace arris::tiling {

/// A batch and where its points lie; of equal lengths.
struct MappedPoints {
  const io::PointBatch& batch;
  std::span<const LatticePoint> positions;
  std::span<const Mapped> outcome;
};

/// Reads the inputs from their start and calls use() for every batch in turn, without records. Begins a phase of that
/// name. Throws IoError, InputError, Cancelled.
void for_each_mapped_batch(io::InputSet& inputs, const Lattice& lattice, std::string_view phase, ProgressSink& progress,
                           const CancelToken& cancel, const std::function<void(const MappedPoints&)>& use);

}  // namespace arris::tiling
