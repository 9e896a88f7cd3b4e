#pragma once
/// @file Sums of survey cells over boxes.

#include <cstdint>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "tiling/box_tree.h"

namespace arris::tiling {

/// A non-empty survey cell, small because there may be a million.
struct PlanCell {
  std::int32_t x = 0, y = 0, z = 0;  ///< In cells: lattice position >> level.
  float spacing_steps = 0.0F;        ///< Local spacing.
  std::uint64_t count = 0;

  std::int32_t operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  LatticeBox box(int level) const;
};

/// Answers "how many points lie in cells that touch this box" in O(log n + cells on the box's rim). Immutable.
class BoxCounts {
 public:
  /// `cells` in any order; sorted into Z-order here. Memory: 24 bytes per cell for the copy, and about 20 more.
  BoxCounts(std::vector<PlanCell> cells, int level);
  std::uint64_t touching(const LatticeBox& box) const;

 private:
  static constexpr std::size_t kBucket = 16;

  std::vector<PlanCell> cells_;
  int level_;
  std::vector<std::uint64_t> before_;  // Points in all buckets before bucket i.
  BoxTree tree_;                       // Over buckets of cells.
};

}  // namespace arris::tiling
