#pragma once
/// @file Polygons that share corners, and the edges that follow from them. Private to synth.

#include <cstddef>
#include <string>
#include <vector>

#include "synth/scene_model.h"

namespace arris::synth {

/// Roles of the edges of a mesh by what they are.
struct MeshRoles {
  std::string free = "eave";      ///< Of one polygon.
  std::string level = "ridge";    ///< Convex and horizontal.
  std::string sloping = "hip";    ///< Convex, not horizontal.
  std::string inside = "valley";  ///< Concave.
};

struct Mesh {
  std::vector<Vec3> corners;
  /// Planar simple polygons, turning either way; two of them share whole sides or nothing.
  std::vector<std::vector<std::size_t>> polygons;
  /// The outside is above sloping and level polygons, and away from this place for upright ones.
  Vec3 inside;
};

/// Adds the polygons, and an edge for every side: a boundary where there is one polygon, a fold where there are two,
/// none where two lie in one plane.
void add_mesh(SceneModel& model, const Mesh& mesh, const Material& material, const MeshRoles& roles = {});

}  // namespace arris::synth
