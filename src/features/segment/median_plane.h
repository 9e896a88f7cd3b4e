#pragma once
/// @file Least median of squares: the plane through three neighbours that half of them are nearest to, one
/// neighbourhood per lane.

#include <array>
#include <bit>
#include <cmath>
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
  std::vector<std::array<std::uint8_t, 2>> exchanges;  ///< Bring the median to its place.
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

/// The plane through three points a, b and c.
template <class F>
struct TriplePlane {
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

/// Least medians so far, one per lane. Most trials are no better than what came before, which counting shows; only
/// those that are wait here, a column each, whatever lane they are of, until the columns are full and can be sorted.
template <class F>
class LeastMedians {
 public:
  static constexpr std::size_t kLanes = sizeof(F) / sizeof(float);
  using Bits = typename simd::Wide<sizeof(F)>::Int;

  explicit LeastMedians(const MedianPlan& plan) : plan_(plan) {}

  /// May be above the least so far, of trials that wait.
  const F& least() const { return least_; }
  const std::array<std::uint8_t, kLanes>& triple() const { return triple_; }

  /// @param distances  of n points, as bits (not negative: they sort as their bits do); one vector each.
  ARRIS_ALWAYS_INLINE void add(std::size_t triple, std::size_t lane, std::size_t n, const Bits* distances) {
    for (std::size_t i = 0; i < n; ++i) columns_[i][waiting_] = distances[i][lane];
    of_[waiting_++] = {static_cast<std::uint8_t>(triple), static_cast<std::uint8_t>(lane)};
    if (waiting_ == kLanes) settle();
  }
  ARRIS_ALWAYS_INLINE void settle() {
    for (const auto& [i, j] : plan_.exchanges) {
      const Bits a = simd::load<Bits>(columns_[i]), b = simd::load<Bits>(columns_[j]);
      simd::store(columns_[i], a < b ? a : b);
      simd::store(columns_[j], a < b ? b : a);
    }
    for (std::size_t column = 0; column < waiting_; ++column) {
      const auto [triple, lane] = of_[column];
      const float median = std::bit_cast<float>(columns_[plan_.median][column]);
      if (!(median < least_[lane])) continue;  // The first of equals stays: triples have a fixed order.
      least_[lane] = median;
      triple_[lane] = triple;
    }
    waiting_ = 0;
  }

 private:
  struct Origin {
    std::uint8_t triple, lane;
  };
  const MedianPlan& plan_;
  F least_ = F{} + 1e30F;
  std::array<std::uint8_t, kLanes> triple_{};
  std::size_t waiting_ = 0;
  std::array<Origin, kLanes> of_;
  alignas(F) std::int32_t columns_[kMostNeighbours][kLanes] = {};
};

/// @param x, y, z  neighbours relative to the query, in units of the mean distance; one vector each.
template <class F>
ARRIS_ALWAYS_INLINE MedianPlane<F> median_plane(const MedianPlan& plan, std::size_t n, const F* x, const F* y,
                                                const F* z) {
  using Bits = typename LeastMedians<F>::Bits;
  const F zero{};
  LeastMedians<F> medians(plan);
  Bits distances[kMostNeighbours];
  for (std::size_t triple = 0; triple < plan.triples.size(); ++triple) {
    const auto [a, b, c] = plan.triples[triple];
    const TriplePlane<F> plane(x[a], y[a], z[a], x[b], y[b], z[b], x[c], y[c], z[c]);
    // A median is below a limit if more values than come before it are.
    const F limit = plane.norm2 > kLeastCross2 ? medians.least() : zero;
    Bits below{};
    for (std::size_t i = 0; i < n; ++i) {
      const F d = plane.nx * x[i] + plane.ny * y[i] + plane.nz * z[i] - plane.offset;
      distances[i] = (Bits)d & 0x7fffffff;
      below = distances[i] < (Bits)limit ? below + 1 : below;  // Neither is negative.
    }
    for (std::size_t lane = 0; lane < LeastMedians<F>::kLanes; ++lane)
      if (below[lane] > static_cast<std::int32_t>(plan.median)) medians.add(triple, lane, n, distances);
  }
  medians.settle();
  F ax, ay, az, bx, by, bz, cx, cy, cz;
  for (std::size_t lane = 0; lane < LeastMedians<F>::kLanes; ++lane) {
    const auto [a, b, c] = plan.triples[medians.triple()[lane]];
    ax[lane] = x[a][lane], ay[lane] = y[a][lane], az[lane] = z[a][lane];
    bx[lane] = x[b][lane], by[lane] = y[b][lane], bz[lane] = z[b][lane];
    cx[lane] = x[c][lane], cy[lane] = y[c][lane], cz[lane] = z[c][lane];
  }
  const TriplePlane<F> plane(ax, ay, az, bx, by, bz, cx, cy, cz);
  const F least = medians.least();
  const auto found = [&](const F& value) { return least < 1e30F ? value : zero; };
  return {found(plane.nx), found(plane.ny), found(plane.nz), found(ax), found(ay), found(az), least};
}

}  // namespace detail
}  // namespace arris
