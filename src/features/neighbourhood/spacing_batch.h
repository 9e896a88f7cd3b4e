#pragma once
/// @file The density spacings of many points at once.

#include <array>
#include <cstddef>
#include <cstdint>

#include "features/neighbourhood/distance_row.h"

namespace arris {

/// Sorts rows of distances side by side, one per lane of a vector, and takes from each what local_spacing() calls the
/// density of kNeighbours neighbours: the same bits. `Key` is std::int32_t or std::int64_t. Not thread-safe.
template <class Key>
class SpacingBatch {
 public:
  static constexpr std::size_t kNeighbours = 20;
  static constexpr std::size_t kCount = 64 / sizeof(Key);
  static_assert(kNeighbours <= DistanceRow::kMostNeighbours);

  /// @param row  of query i, with at least kNeighbours neighbours.
  void set(std::size_t i, const DistanceRow::Keys<Key>& row) { rows_[i] = row; }
  /// All; those that were never set give anything.
  void solve();
  /// Steps.
  double density(std::size_t i) const { return density_[i]; }
  std::int64_t last_d2(std::size_t i) const { return last_d2_[i]; }

 private:
  struct Kernel;
  static constexpr std::size_t kFirst = kNeighbours / 2;  ///< The farther half counts.
  template <class T>
  using Lanes = std::array<T, kCount>;

  alignas(64) std::array<DistanceRow::Keys<Key>, kCount> rows_{};
  alignas(64) std::array<Lanes<Key>, kNeighbours - kFirst> sorted_{};  ///< Of the farther half.
  alignas(64) Lanes<double> density_{};
  Lanes<Key> last_d2_{};
};

extern template class SpacingBatch<std::int32_t>;
extern template class SpacingBatch<std::int64_t>;

}  // namespace arris
