#pragma once
/// @file Neighbourhoods side by side, one per lane, for kernels that do the same to all of them.

#include <array>
#include <cstddef>

namespace arris {

/// Neighbourhoods in a batch: as many as the widest vectors have floats.
constexpr std::size_t kBatchLanes = 16;
/// Most neighbours of a point.
constexpr std::size_t kMostNeighbours = 64;

/// `neighbours` points around each of `lanes` queries, all with the same number; positions relative to the query, in
/// steps, exact. Lanes that are not in use must hold finite numbers.
struct NeighbourhoodBatch {
  using Row = std::array<double, kBatchLanes>;

  std::size_t neighbours = 0;
  std::size_t lanes = 0;
  std::array<Row, kMostNeighbours> x{}, y{}, z{};
  Row mean_distance{};  ///< mu: of the neighbours from the query, steps, > 0 in lanes in use.
};

/// Planes through neighbourhoods (the query is one of the points).
struct PlaneBatch {
  using Row = NeighbourhoodBatch::Row;

  Row nx{}, ny{}, nz{};  ///< Unit normal, sign free.
  Row variation{};       ///< sigma_p = l0 / (l0 + l1 + l2), in [0, 1/3].
  Row width{};           ///< l1 / l2, in [0, 1]: 0 where the points are on a line, and the normal means nothing.
  Row farthest{};        ///< Largest distance of a point from the plane, in units of mean_distance.
};

}  // namespace arris
