#pragma once
/// @file The part of space that a set of queries must see, as a sparse set of cells.

#include <cstdint>
#include <vector>

#include "core/lattice.h"

namespace arris::tiling {

/// Union of the boxes position +- reach, rounded up to absolute cells whose size follows the reach of each query (at
/// most 27 cells a query). contains() may say yes outside the union, never no inside it. Thread-safe for reading.
class QueryRegions {
 public:
  /// @param reach_steps  >= 0.
  void add(const LatticePoint& position, std::int64_t reach_steps);
  bool contains(const LatticePoint& position) const;
  /// True if the box of some query touches `box`.
  bool touches(const LatticeBox& box) const;
  const LatticeBox& bounds() const { return bounds_; }

 private:
  void insert(std::uint64_t key);
  bool has(std::uint64_t key) const;
  void grow();

  static constexpr int kLevels = 33;
  std::uint64_t levels_ = 0;  ///< Bit l: cells of 2^l steps are in use.
  LatticeBox bounds_;
  std::vector<LatticeBox> boxes_;     ///< Of every query.
  std::vector<std::uint64_t> table_;  ///< Open addressing; 0 = empty slot.
  std::size_t used_ = 0;
};

}  // namespace arris::tiling
