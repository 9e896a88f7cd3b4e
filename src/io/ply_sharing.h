#pragma once
/// @file Which PLY inputs can share one output, and which elements survive a choice of vertices.

#include <vector>

#include "io/ply_header.h"
#include "io/point_source.h"

namespace arris::io {

/// Throws ConfigError that names the difference unless all inputs have the vertex properties of the first one, in the
/// same order and, with `same_encoding`, the same format.
void check_ply_sharing(const std::vector<SourceInfo>& inputs, bool same_encoding);

/// True if an element may hold indices of vertices, which a choice of vertices makes wrong: it has a list, or a
/// property or name that speaks of vertices, points or indices.
bool refers_to_vertices(const PlyElement& element);

}  // namespace arris::io
