#pragma once
/// @file Finds the leaf size at which leaves are well filled, and groups points by leaf.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "core/pages.h"

namespace arris::tiling {

/// The leaves of 2^level steps a side that hold points, made in one pass: it starts with small leaves and doubles their
/// side whenever there are more than the points can fill. Points too far apart for the largest leaves have no index: it
/// is given up as soon as that is certain. Memory: about 64 bytes per leaf and 4 bytes per point until they are
/// grouped.
class LeafIndex {
 public:
  /// @param first_level, last_level  smallest and largest leaf.
  /// @param points_per_leaf          wanted average, >= 1.
  /// @param least_points_per_leaf    average with which the largest leaves will do, >= 1.
  LeafIndex(std::span<const LatticePoint> points, int first_level, int last_level, std::size_t points_per_leaf,
            std::size_t least_points_per_leaf);

  /// There is no index: nothing else may be asked.
  bool scattered() const { return scattered_; }
  int level() const { return level_; }
  std::size_t size() const { return keys_.size(); }
  /// Number of cubes of 2^log2 leaves a side that hold points. Memory: 12 bytes per leaf.
  std::size_t cubes(int log2) const;
  /// Lowest corner of leaf `leaf`.
  LatticePoint origin(std::size_t leaf) const;
  /// Fills `order` with the indices of all points, leaf by leaf, ascending within a leaf; `begin` gets size() + 1
  /// starts. Call once: the leaves of the points are forgotten then.
  void group(PageVector<std::uint32_t>& order, std::vector<std::uint32_t>& begin);

 private:
  std::uint32_t find_or_add(const LatticePoint& key);
  void rehash(std::size_t slots);
  /// The first `points` have their leaves.
  void coarsen(std::size_t points);
  LatticePoint key_of(const LatticePoint& p) const { return {p.x >> level_, p.y >> level_, p.z >> level_}; }

  int level_;
  bool scattered_ = false;
  std::vector<LatticePoint> keys_;     // Positions >> level_.
  std::vector<std::uint32_t> slots_;   // Open addressing: index into keys_ + 1, 0 = free.
  PageVector<std::uint32_t> leaf_of_;  // Per point.
};

}  // namespace arris::tiling
