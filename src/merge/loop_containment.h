#pragma once
/// @file Which loop lies in which.

#include <cstdint>
#include <span>
#include <vector>

#include "merge/outline_loops.h"

namespace arris::merge {

/// Finds the loops that a place lies in; edges are sorted into strips, so that few are looked at.
class LoopContainment {
 public:
  /// @param loops  kept by reference; no two edges cross.
  LoopContainment(std::span<const Loop> loops, std::span<const PlanePosition> at);

  /// Loops that hold the middle of the edge a -> b, ascending; of a loop that has this edge nothing is said.
  /// O(edges in the strip).
  std::vector<std::uint32_t> around(std::uint32_t a, std::uint32_t b) const;

 private:
  struct Edge {
    std::uint32_t from, to, loop;
  };
  std::size_t strip(std::int64_t y) const;

  std::span<const PlanePosition> at_;
  std::int64_t low_ = 0, height_ = 1;  ///< Of the first strip.
  std::vector<std::vector<Edge>> strips_;
};

}  // namespace arris::merge
