#pragma once
/// @file Which LAS inputs can share one LAS output.

#include <cstddef>
#include <string>
#include <vector>

#include "io/point_source.h"

namespace arris::io {

/// Why an input's records cannot follow those of the first one unchanged: another point format, record length, scale,
/// offset, extra bytes, kind of GPS time, or waveforms, whose data are found by their place in the file. Empty if all
/// can.
std::string las_difference(const std::vector<SourceInfo>& inputs);

/// True if the records of all inputs end with the same extra bytes, whatever their point formats.
bool same_extra_bytes(const std::vector<SourceInfo>& inputs);

/// Extended records behind the points of inputs after the first one: an output has those of the first only.
std::size_t later_extended_records(const std::vector<SourceInfo>& inputs);

}  // namespace arris::io
