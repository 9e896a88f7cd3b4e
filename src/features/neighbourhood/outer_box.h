#pragma once
/// @file Boxes for the search in a PointTree: float sides, rounded outwards, that four lanes take at once.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "features/neighbourhood/closed_box.h"
#include "features/numerics/simd.h"

#if ARRIS_X86_KERNELS
#include <xmmintrin.h>
#endif

namespace arris {

/// Holds the box it is made of; each side is at most 128 steps off, and exact below 2^24 steps.
struct alignas(16) OuterBox {
  float min[4] = {0.0F, 0.0F, 0.0F, 0.0F};
  float max[4] = {0.0F, 0.0F, 0.0F, 0.0F};

  OuterBox() = default;
  explicit OuterBox(const ClosedBox& box) {
    for (int axis = 0; axis < 3; ++axis) {
      min[axis] = at_most(box.min[axis]);
      max[axis] = -at_most(-std::int64_t{box.max[axis]});
    }
  }

 private:
  static float at_most(std::int64_t value) {
    const auto nearest = static_cast<float>(value);  // |value| <= 2^31, where doubles are exact.
    if (static_cast<double>(nearest) <= static_cast<double>(value)) return nearest;
    return std::nextafter(nearest, -std::numeric_limits<float>::infinity());
  }
};

/// At most kBoxDistanceError more than the squared distance of the boxes, as a share of it.
constexpr double kBoxDistanceError = 1e-6;
inline float squared_distance(const OuterBox& a, const OuterBox& b) {
#if ARRIS_X86_KERNELS
  const __m128 below = _mm_sub_ps(_mm_load_ps(a.min), _mm_load_ps(b.max));
  const __m128 above = _mm_sub_ps(_mm_load_ps(b.min), _mm_load_ps(a.max));
  const __m128 gap = _mm_max_ps(_mm_max_ps(below, above), _mm_setzero_ps());
  const __m128 square = _mm_mul_ps(gap, gap);
  const __m128 y = _mm_shuffle_ps(square, square, 1);
  const __m128 z = _mm_movehl_ps(square, square);
  return _mm_cvtss_f32(_mm_add_ss(_mm_add_ss(square, y), z));
#else
  float sum = 0.0F;
  for (int axis = 0; axis < 3; ++axis) {
    const float gap = std::max(std::max(a.min[axis] - b.max[axis], b.min[axis] - a.max[axis]), 0.0F);
    sum += gap * gap;
  }
  return sum;
#endif
}

}  // namespace arris
