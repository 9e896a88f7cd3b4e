#pragma once
/// @file Intensities of all points as 8 bits, for segments that differ by how they reflect.

#include <cstdint>
#include <vector>

#include "core/cancel.h"
#include "core/progress.h"
#include "features/segment/intensity_scale.h"
#include "io/point_source.h"

namespace arris::pipeline {

/// How the intensities of an input became bytes.
struct IntensityRange {
  bool has = false;  ///< The file has intensities: LAS, and PLY with a property for them.
  IntensityScale scale;
};

struct IntensityTable {
  std::vector<std::uint8_t> of_point;  ///< By global id; empty if an input with points has no intensities.
  std::vector<IntensityRange> files;   ///< Per input.
  bool complete() const { return !of_point.empty(); }
};

/// Reads `intensity` of LAS and PLY (also under its other names, io/ply_field_names.h). If an input with points has
/// none, the table is not complete and no point is read. The scale (IntensityScale) is chosen for all LAS inputs
/// together and for all PLY inputs together, never for a single file, because nothing may depend on how a scan is split
/// into files. Exclusions and filters of the inputs play no part (setting them later saves their time).
///
/// Passes over the inputs: one for 8-bit values and for LAS of up to 8 million points, two for LAS of more, three for
/// PLY of more than 8 bits. Memory: 1 byte per point of the inputs, and while it runs 2 MB and, for LAS of up to 8
/// million points, 2 bytes per point.
IntensityTable read_intensities(io::InputSet& inputs, ProgressSink& progress, const CancelToken& cancel);

}  // namespace arris::pipeline
