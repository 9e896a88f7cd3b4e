#pragma once
/// @file Least median of squares: the plane through three neighbours that half of them are nearest to, one
/// neighbourhood per lane.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "features/numerics/simd.h"
#include "features/segment/neighbourhood_batch.h"

namespace arris {

/// What is tried for neighbourhoods of n points. All triples if there are at most kMostTriples of them (n <= 8), else
/// that many, spread by a fixed rule. Source: Rousseeuw (1984); the start is deterministic instead of drawn.
struct MedianPlan {
  static constexpr std::size_t kMostTriples = 56;  ///< C(8, 3).

  /// @param neighbours  3 to kMostNeighbours.
  explicit MedianPlan(std::size_t neighbours);

  std::vector<std::array<std::uint8_t, 3>> triples;
  std::vector<std::array<std::uint8_t, 2>> exchanges;  ///< Batcher's merge exchange: sorts n values.
  std::size_t median = 0;                              ///< Index of the upper median of n sorted values.
};

namespace detail {

template <class F>
struct MedianPlane {
  F nx, ny, nz;  ///< Unit normal; all 0 if every triple is (nearly) on a line.
  F px, py, pz;  ///< One of the three points, in units of the mean distance.
  F median;      ///< Of the neighbours' distances from it, in those units.
};

/// A cross product shorter than this, of vectors of about unit length, has no direction worth having.
constexpr float kLeastCross2 = 1e-4F;

/// @param x, y, z  neighbours relative to the query, in units of the mean distance; one vector each.
template <class F>
ARRIS_ALWAYS_INLINE MedianPlane<F> median_plane(const MedianPlan& plan, std::size_t n, const F* x, const F* y,
                                                const F* z) {
  const F zero = x[0] - x[0];
  MedianPlane<F> best{zero, zero, zero, zero, zero, zero, zero + 1e30F};
  F distance[kMostNeighbours];
  for (const auto& [a, b, c] : plan.triples) {
    const F ux = x[b] - x[a], uy = y[b] - y[a], uz = z[b] - z[a];
    const F vx = x[c] - x[a], vy = y[c] - y[a], vz = z[c] - z[a];
    F nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const F norm2 = nx * nx + ny * ny + nz * nz;
    const F safe = norm2 > kLeastCross2 ? norm2 : zero + 1.0F;
    F inverse;
    for (std::size_t lane = 0; lane < sizeof(F) / sizeof(float); ++lane) inverse[lane] = 1.0F / std::sqrt(safe[lane]);
    nx *= inverse;
    ny *= inverse;
    nz *= inverse;
    const F offset = nx * x[a] + ny * y[a] + nz * z[a];
    for (std::size_t i = 0; i < n; ++i) {
      const F d = nx * x[i] + ny * y[i] + nz * z[i] - offset;
      distance[i] = d < 0.0F ? -d : d;
    }
    for (const auto& [i, j] : plan.exchanges) {
      const F low = distance[i] < distance[j] ? distance[i] : distance[j];
      const F high = distance[i] < distance[j] ? distance[j] : distance[i];
      distance[i] = low;
      distance[j] = high;
    }
    const F median = norm2 > kLeastCross2 ? distance[plan.median] : zero + 1e30F;
    best.nx = median < best.median ? nx : best.nx;  // The first of equals stays: triples have a fixed order.
    best.ny = median < best.median ? ny : best.ny;
    best.nz = median < best.median ? nz : best.nz;
    best.px = median < best.median ? x[a] : best.px;
    best.py = median < best.median ? y[a] : best.py;
    best.pz = median < best.median ? z[a] : best.pz;
    best.median = median < best.median ? median : best.median;
  }
  return best;
}

}  // namespace detail
}  // namespace arris
