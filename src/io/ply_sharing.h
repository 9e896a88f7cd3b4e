#pragma once
/// @file Which PLY inputs can share one output, and which elements survive a choice of vertices.

#include <string>
#include <vector>

#include "io/ply_header.h"
#include "io/point_source.h"

namespace arris::io {

/// How an input differs from the first one in its format or the properties of its vertices; empty if none does.
std::string ply_difference(const std::vector<SourceInfo>& inputs);

/// True if an element may hold indices of vertices, which a choice of vertices makes wrong: it has a list, or a
/// property or name that speaks of vertices, points or indices.
bool refers_to_vertices(const PlyElement& element);

}  // namespace arris::io
