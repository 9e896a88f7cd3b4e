#pragma once
/// @file Sums of ground points per cell of an absolute grid: what a ground model is made of.

#include <array>
#include <cstdint>

#include "features/ground/ground_blocks.h"

namespace arris {

/// Collects ground points, coordinates in data units. Cells are squares of 2^level units on multiples of their size;
/// level 0 to begin with.
///
/// Laws: (1) the sums depend on the set of points only, neither on their order nor on how they were spread over
/// objects that were merged: they are sums of integers, of coordinates in steps of 1/256 unit. (2) The level is the
/// finest from 0 on at which the points lie in at most kMostBlocks blocks: coarsening loses nothing else.
///
/// Memory: 8 kB per block, at most 34 MB; half as much again while coarsening. With points everywhere that is a square
/// kilometre at 1 unit, 4 at 2, 16 at 4. Not thread-safe.
class GroundSums {
 public:
  static constexpr std::size_t kMostBlocks = 4096;
  /// Points with a horizontal coordinate beyond, or a height beyond kMostHeight, are left out: no sum of 2^31 points
  /// leaves 64 bits.
  static constexpr double kMostCoordinate = 0x1p34;
  static constexpr double kMostHeight = 0x1p24;
  static constexpr int kStepBits = 8;

  struct Cell {
    std::int64_t x = 0, y = 0;  ///< From the cell's lowest corner, steps.
    std::int64_t z = 0;         ///< Steps.
    std::int64_t count = 0;
  };
  using Block = std::array<Cell, kGroundBlockCells>;

  /// Points that are not finite or out of range change nothing.
  void add(double x, double y, double z);
  void merge(const GroundSums& other);
  /// To the next level.
  void coarsen();

  bool empty() const { return blocks_.empty(); }
  int level() const { return level_; }
  const GroundBlocks<Block>& blocks() const { return blocks_; }
  /// Leaves this empty.
  GroundBlocks<Block> take_blocks();

 private:
  Cell& cell(std::int64_t cell_x, std::int64_t cell_y);
  /// Sums of a level up to this one.
  void add_blocks(const GroundBlocks<Block>& blocks, int level);
  void keep_bound();

  int level_ = 0;
  GroundBlocks<Block> blocks_;
  GroundBlockKey last_key_;  ///< Of last_block_, where the next point most likely lies too.
  Block* last_block_ = nullptr;
};

}  // namespace arris
