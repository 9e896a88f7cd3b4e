#pragma once
/// @file Points per absolute cell, sparse.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "tiling/cell_runs.h"

namespace arris::tiling {

/// Of CellCounts, unless told otherwise.
constexpr std::size_t kMostCellLeaves = 8192;

/// Cells that have the same number of points.
struct CellClass {
  std::uint64_t points = 0;  ///< In each.
  std::uint64_t cells = 0;
};

/// Counts points in cells of 2^level lattice steps (cell c covers [c << level, (c + 1) << level) per axis). Starts fine
/// and coarsens by a factor of two whenever more than max_leaves leaves (of 8x8x8 cells) are active. The final level
/// and the counts depend on the set of points only, not on their order: it is the finest level, from first_level on, at
/// which the whole set fits. Counts of any size are exact.
///
/// Memory: at most 1.2 kB per leaf (10 MB for 8192 leaves wherever they lie), half as much again for a moment while
/// coarsening; 50 bytes more for each cell of more than 32 thousand points. Speed: about 100 M points/s when neighbours
/// in the input are neighbours in space, a hash or map look-up per point otherwise. Not thread-safe.
class CellCounts {
 public:
  /// @param first_level  level to start from, 0..30.
  /// @param max_leaves   >= 1. Level 30 is never left, whatever the number of leaves (it has at most 8).
  explicit CellCounts(int first_level = 0, std::size_t max_leaves = kMostCellLeaves);
  ~CellCounts();
  CellCounts(CellCounts&&) noexcept;
  CellCounts& operator=(CellCounts&&) noexcept;

  void add(std::span<const LatticePoint> points);
  /// The same with the points of `runs`, whose level must not be coarser than what all points will need: level() at any
  /// time before, or that of level_that_fits() for some of the points.
  void add(const CellRuns& runs);
  /// As `count` times add() of the same point, count >= 0.
  void add(const LatticePoint& point, std::uint64_t count);
  /// Takes points away again. Calls emptied(cell box) for every cell whose last point went, once per such event.
  /// Returns the number of points that were not there to be taken (0 unless the caller mixed up its sets); they change
  /// nothing.
  std::size_t remove(std::span<const LatticePoint> points, const std::function<void(const LatticeBox& cell)>& emptied);

  int level() const;
  std::uint64_t total() const;
  std::size_t active_cells() const;
  std::size_t memory_bytes() const;
  /// All non-empty cells by their points, ascending. O(cells).
  std::vector<CellClass> classes() const;
  /// Points in the cell that contains `position`.
  std::uint64_t count_at(const LatticePoint& position) const;
  /// A copy at a level >= level(), with the same total.
  CellCounts coarsened(int level) const;
  /// Calls visit(cell box, count) for every non-empty cell, in ascending (x, y, z) order of cells.
  void for_each(const std::function<void(const LatticeBox& cell, std::uint64_t count)>& visit) const;
  /// The same leaf by leaf, which is quicker: an order that depends on the set of cells only.
  void for_each_by_leaf(const std::function<void(const LatticeBox& cell, std::uint64_t count)>& visit) const;

 private:
  struct Impl;
  explicit CellCounts(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace arris::tiling
