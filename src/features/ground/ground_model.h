#pragma once
/// @file Height of the ground everywhere, from points that lie on it.

#include <cstddef>
#include <vector>

#include "features/ground/ground_level.h"
#include "features/ground/ground_sums.h"

namespace arris {

/// A continuous surface (but for the borders of what was scanned) through the means of ground points in cells of one
/// unit of the coordinates or, of large scans, 2, 4, ... (GroundSums). Holes, as under buildings, are spanned like a
/// membrane from one side to the other, whatever their size: levels of cells of twice the side each are solved from the
/// coarsest to the finest. Slopes go on through holes; outside of the ground points the surface becomes level.
///
/// Error on a plane that rises by g per unit, at cells of one unit: g / 100 where ground points are denser than the
/// cells, g / 5 where they are 3 units apart (at the rim of what was scanned g and 5 g); in holes of 60 units g / 4, of
/// 200 units up to 2 g. Within two cells of a cliff the error may reach a tenth of its height; where the ground
/// bends under a hole, its rim tells nothing of that.
///
/// The same points give the same heights, bit for bit, in any order. Memory: 3 kB per block of the levels, at most
/// 8192 blocks (22 MB; 15 MB for a square kilometre in one piece), while it is made up to 75 MB (50 MB). Making it
/// takes half a second at most. Immutable; height_at is thread-safe.
class GroundModel {
 public:
  /// Takes the sums apart. They must not be empty.
  explicit GroundModel(GroundSums&& sums);

  /// @param x, y  finite; out of the bounds of the ground the height is that of their border there. About 30 ns.
  double height_at(double x, double y) const;
  double cell_size() const { return cell_size_; }
  /// Blocks of all levels.
  std::size_t blocks() const;

 private:
  double surface(std::size_t level, double x, double y) const;

  double cell_size_ = 1.0;
  GroundBounds bounds_;
  double mean_ = 0.0;                ///< Of all ground points.
  std::vector<GroundLevel> levels_;  ///< Coarsest first.
};

}  // namespace arris
