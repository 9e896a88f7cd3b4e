#pragma once
/// @file Which LAS inputs can share one LAS output.

#include <string>
#include <vector>

#include "io/point_source.h"

namespace arris::io {

/// Throws ConfigError that names the difference if an input's records cannot follow those of the first one unchanged:
/// other point format, record length, scale, offset or extra bytes, or waveforms, whose data are found by their place
/// in the file. Adds a warning where coordinate reference systems differ or where records behind the points of later
/// inputs are left out.
void check_las_sharing(const std::vector<SourceInfo>& inputs, std::vector<std::string>& warnings);

}  // namespace arris::io
