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
  LatticePoint corner;         ///< The lowest.
  float spacing_steps = 0.0F;  ///< Local spacing.
  std::uint64_t count = 0;
  int level = 0;  ///< Its side is 2^level steps.

  LatticeBox box() const;
};

/// Answers "how many points lie in cells that touch this box" in O(log n + cells on the box's rim). Immutable.
class BoxCounts {
 public:
  /// `cells` in any order, disjoint; sorted into Z-order here. Memory: 32 bytes per cell for the copy, and about 20
  /// more.
  explicit BoxCounts(std::vector<PlanCell> cells);
  std::uint64_t touching(const LatticeBox& box) const;

 private:
  static constexpr std::size_t kBucket = 16;

  std::vector<PlanCell> cells_;
  std::vector<std::uint64_t> before_;  // Points in all buckets before bucket i.
  BoxTree tree_;                       // Over buckets of cells.
};

}  // namespace arris::tiling
