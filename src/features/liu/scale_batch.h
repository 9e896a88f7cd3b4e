#pragma once
/// @file The number of neighbours of eight queries at once.

#include <array>
#include <cstddef>
#include <vector>

#include "features/liu/entropy_scale.h"

namespace arris {

/// Tries k = k_min, k_min + step, ... up to min(k_max, neighbours). The sums are exact while k * distance² < 2^53;
/// beyond, the canonical order of the neighbours makes the rounding the same everywhere. Law: bits depend neither on
/// the other queries nor on the vectors' width. Not thread-safe.
class ScaleBatch {
 public:
  static constexpr std::size_t kCount = 8;

  explicit ScaleBatch(const ScaleRange& range);

  /// @param neighbours  of query i, of which those beyond k_max are left out; with room for k_max, and alive until
  ///                    solve() returns.
  void set(std::size_t i, const Neighbours& neighbours);
  /// All eight; those that were never set give anything. O(k_max).
  void solve();
  ScaleChoice choice(std::size_t i) const;

 private:
  struct Kernel;
  using Lanes = std::array<double, kCount>;
  using Row = std::array<const double*, 3>;  ///< x, y, z of the neighbours of one query.
  struct alignas(64) Choices {
    Lanes k{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{}, largest{}, middle{}, smallest{};
  };

  ScaleRange range_;
  std::array<Row, kCount> rows_;
  struct alignas(64) Offset : std::array<Lanes, 3> {};
  std::vector<Offset> offsets_;  ///< Of the j-th neighbours of all queries.
  std::vector<double> nothing_;  ///< The row of a query that was not set.
  alignas(64) Lanes count_{};
  Choices choices_;
};

}  // namespace arris
