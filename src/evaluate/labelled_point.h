#pragma once
/// @file A point with the label that a segmentation gives it and the one it should have.

#include <cmath>
#include <cstdint>

#include "evaluate/vec3.h"

namespace arris::evaluate {

struct LabelledPoint {
  Vec3 position;
  std::uint32_t segment = 0;  ///< Given by the segmentation; 0: none.
  std::uint32_t face = 0;     ///< Of the truth; 0: on no surface (a stray point), which nobody can get right.
};

inline bool has_position(const LabelledPoint& p) {
  return std::isfinite(p.position.x) && std::isfinite(p.position.y) && std::isfinite(p.position.z);
}

/// Only these are judged, but for planes (plane_comparison.h); the others are as if they were not there.
inline bool is_judged(const LabelledPoint& p) {
  return p.face != 0 && has_position(p);
}

}  // namespace arris::evaluate
