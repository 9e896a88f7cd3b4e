#pragma once
/// @file Names under which programs export the fields of LAS points to PLY.

#include <array>
#include <span>
#include <string_view>

#include "io/ply_header.h"

namespace arris::io {

struct PlyFieldAlias {
  std::string_view field;            ///< As las_fields.h calls it.
  std::array<const char*, 5> names;  ///< The first that is there is taken; null behind the last.
};
std::span<const PlyFieldAlias> ply_field_aliases();

/// Index of the scalar property that holds a field, under its own name or another; -1 if there is none.
int find_ply_field(const PlyElement& vertices, std::string_view field);

}  // namespace arris::io
