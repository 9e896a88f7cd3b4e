#pragma once
/// @file The LAS reader behind open_point_source().

#include <filesystem>
#include <memory>

#include "io/point_source.h"

namespace arris::io {

std::unique_ptr<PointSource> open_las_source(const std::filesystem::path& path);

}  // namespace arris::io
