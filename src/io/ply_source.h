#pragma once
/// @file The PLY reader behind open_point_source().

#include <memory>

#include "io/input_file.h"
#include "io/point_source.h"

namespace arris::io {

std::unique_ptr<PointSource> open_ply_source(std::shared_ptr<const InputFile> file, Tolerance tolerance);

}  // namespace arris::io
