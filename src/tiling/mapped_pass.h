#pragma once
/// @file One pass over all points as lattice points.

#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

#include "core/cancel.h"
#include "core/lattice.h"
#include "core/progress.h"
#include "io/point_source.h"
#include "tiling/lattice_mapper.h"

namespace arris::tiling {

/// A batch and where its points lie; of equal lengths.
struct MappedPoints {
  io::PointBatch batch;
  std::size_t source = 0;  ///< Of the inputs.
  std::vector<LatticePoint> positions;
  std::vector<Mapped> outcome;
};

/// Reads the inputs from their start, batch by batch, without records.
class MappedReader {
 public:
  MappedReader(io::InputSet& inputs, const Lattice& lattice);
  /// False at the end. Throws IoError, InputError.
  bool read(MappedPoints& points, std::size_t batch_points = io::ReadOptions().batch_points);
  /// The two halves of it: the batch, and where its points lie, which any thread may find while the next is fetched.
  bool fetch(MappedPoints& points, std::size_t batch_points = io::ReadOptions().batch_points);
  void map(MappedPoints& points) const;

 private:
  io::InputSet& inputs_;
  LatticeMapper mapper_;
};

/// Reads the inputs from their start and calls use() for every batch in turn, without records, while the next one is
/// read. Begins a phase of that name. Throws IoError, InputError, Cancelled.
void for_each_mapped_batch(io::InputSet& inputs, const Lattice& lattice, std::string_view phase, ProgressSink& progress,
                           const CancelToken& cancel, const std::function<void(const MappedPoints&)>& use);

}  // namespace arris::tiling
