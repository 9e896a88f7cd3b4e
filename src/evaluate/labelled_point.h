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

/// Only these are judged; the others are as if they were not there.
inline bool is_judged(const LabelledPoint& p) {
  return p.face != 0 && std::isfinite(p.position.x) && std::isfinite(p.position.y) && std::isfinite(p.position.z);
}

}  // namespace arris::evaluate
