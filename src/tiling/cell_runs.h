#pragma once
/// @file Points on their way to being counted.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tiling/cell.h"

namespace arris::tiling {

/// So many points of a cell, at least one.
struct CellRun {
  Cell cell{};
  std::uint64_t points = 0;
};

/// Points as runs of neighbours in the same cell: made by any thread, beside the counting of others.
class CellRuns {
 public:
  void clear(int level) {
    level_ = level;
    points_ = 0;
    runs_.clear();
  }
  void add(std::span<const LatticePoint> points) {
    for (std::size_t begin = 0; begin < points.size();) {
      const std::size_t end = end_of_run(points, begin, level_);
      runs_.push_back({cell_of(points[begin], level_), end - begin});
      begin = end;
    }
    points_ += points.size();
  }

  int level() const { return level_; }  ///< Of their cells.
  std::uint64_t points() const { return points_; }
  std::span<const CellRun> runs() const { return runs_; }

 private:
  int level_ = 0;
  std::uint64_t points_ = 0;
  std::vector<CellRun> runs_;
};

}  // namespace arris::tiling
