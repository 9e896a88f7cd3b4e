#pragma once
/// @file Least median of squares: the plane through three neighbours that half of them are nearest to, one
/// neighbourhood per lane.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "features/numerics/simd.h"
#include "features/segment/least_medians.h"
#include "features/segment/neighbourhood_batch.h"

namespace arris {

/// What is tried for neighbourhoods of n points. All triples if there are at most kMostTriples of them (n <= 8), else
/// that many, spread by a fixed rule. Source: Rousseeuw (1984); the start is deterministic instead of drawn.
struct MedianPlan {
  static constexpr std::size_t kMostTriples = 56;  ///< C(8, 3).

  /// @param neighbours  3 to kMostNeighbours.
  explicit MedianPlan(std::size_t neighbours);

  std::vector<std::array<std::uint8_t, 3>> triples;
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

/// The plane through three points a, b and c.
template <class F>
struct TriplePlane {
  TriplePlane() = default;
  ARRIS_ALWAYS_INLINE TriplePlane(const F& ax, const F& ay, const F& az, const F& bx, const F& by, const F& bz,
                                  const F& cx, const F& cy, const F& cz) {
    const F ux = bx - ax, uy = by - ay, uz = bz - az;
    const F vx = cx - ax, vy = cy - ay, vz = cz - az;
    nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    norm2 = nx * nx + ny * ny + nz * nz;
    const F safe = norm2 > kLeastCross2 ? norm2 : F{} + 1.0F;
    F inverse;
    for (std::size_t lane = 0; lane < sizeof(F) / sizeof(float); ++lane) inverse[lane] = 1.0F / std::sqrt(safe[lane]);
    nx *= inverse;
    ny *= inverse;
    nz *= inverse;
    offset = nx * ax + ny * ay + nz * az;
  }

  F nx, ny, nz;
  F norm2;  ///< Of the cross product: no plane up to kLeastCross2.
  F offset;
};

/// Triples that are tried at a time.
constexpr std::size_t kTogether = 2;

/// Neighbours relative to the query, in units of the mean distance, one vector each; `distances` for median_plane().
template <class F, std::size_t N>
struct MedianPoints {
  F x[N], y[N], z[N];
  std::array<typename LeastMedians<F, N>::Rows, kTogether> distances;
};

/// @param n  3 to N.
template <class F, std::size_t N>
ARRIS_ALWAYS_INLINE MedianPlane<F> median_plane(const MedianPlan& plan, std::size_t n, MedianPoints<F, N>& points) {
  using Medians = LeastMedians<F, N>;
  using Bits = typename Medians::Bits;
  const F zero{};
  const auto& [x, y, z, distances] = points;
  Medians medians(n);
  for (auto& rows : points.distances) medians.pad(rows);
  const Bits middle = Bits{} + static_cast<std::int32_t>(n / 2);
  for (std::size_t begin = 0; begin < plan.triples.size(); begin += kTogether) {
    // Several at a time, because each point is loaded but once then. (The last one again is no better than itself.)
    std::array<TriplePlane<F>, kTogether> planes;
    std::array<Bits, kTogether> limits, below{};
    ARRIS_UNROLL
    for (std::size_t k = 0; k < kTogether; ++k) {
      const auto [a, b, c] = plan.triples[std::min(begin + k, plan.triples.size() - 1)];
      planes[k] = TriplePlane<F>(x[a], y[a], z[a], x[b], y[b], z[b], x[c], y[c], z[c]);
      // A median is below a limit if more values than come before it are.
      limits[k] = (Bits)(planes[k].norm2 > kLeastCross2 ? medians.least() : zero);
    }
    for (std::size_t i = 0; i < n; ++i) {
      ARRIS_UNROLL
      for (std::size_t k = 0; k < kTogether; ++k) {
        const TriplePlane<F>& plane = planes[k];
        const F d = plane.nx * x[i] + plane.ny * y[i] + plane.nz * z[i] - plane.offset;
        const Bits distance = (Bits)d & 0x7fffffff;
        points.distances[k][i] = distance;
        below[k] = distance < limits[k] ? below[k] + 1 : below[k];  // Neither is negative.
      }
    }
    for (std::size_t k = 0; k < kTogether; ++k)
      medians.add(static_cast<std::int32_t>(begin + k), middle - below[k], points.distances[k]);
  }
  medians.settle();
  F ax, ay, az, bx, by, bz, cx, cy, cz;
  for (std::size_t lane = 0; lane < Medians::kLanes; ++lane) {
    const auto [a, b, c] = plan.triples[medians.trial(lane)];
    ax[lane] = x[a][lane], ay[lane] = y[a][lane], az[lane] = z[a][lane];
    bx[lane] = x[b][lane], by[lane] = y[b][lane], bz[lane] = z[b][lane];
    cx[lane] = x[c][lane], cy[lane] = y[c][lane], cz[lane] = z[c][lane];
  }
  const TriplePlane<F> plane(ax, ay, az, bx, by, bz, cx, cy, cz);
  const F least = medians.least();
  const auto found = [&](const F& value) __attribute__((always_inline)) {
    return least < 1e30F ? value : zero;
  };
  return {found(plane.nx), found(plane.ny), found(plane.nz), found(ax), found(ay), found(az), least};
}

}  // namespace detail
}  // namespace arris
