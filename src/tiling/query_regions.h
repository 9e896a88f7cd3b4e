#pragma once
/// @file The part of space that a set of queries must see, as balls that are found by the cells they touch.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/lattice.h"

namespace arris::tiling {

/// Union of the balls of radius reach around positions. Answers are exact. Balls are kept by absolute cells of the
/// power of two that is at most their reach: at most 125 cells each, of 16 bytes, and 8 bytes more for each that the
/// ball does not fill. Time of a question: the balls that touch the cell of the point. Thread-safe for reading.
class QueryRegions {
 public:
  /// @param reach_steps  >= 0; points at this distance are contained.
  void add(const LatticePoint& position, std::int64_t reach_steps);
  bool contains(const LatticePoint& position) const;
  /// True if some ball holds a lattice position of `box`.
  bool touches(const LatticeBox& box) const;

 private:
  struct Ball {
    LatticePoint centre;
    std::int64_t reach = 0;
    bool contains(const LatticePoint& p) const;
    bool touches(const LatticeBox& box) const;
    bool fills(const LatticeBox& box) const;
  };
  struct Link {
    std::uint32_t ball;
    std::uint32_t next;
  };
  struct Cell {
    std::uint64_t key = 0;  ///< 0: none.
    std::uint32_t first = 0;
  };
  /// In place of the first link: a ball fills the cell.
  static constexpr std::uint32_t kFilled = 0xffffffffU;
  static constexpr std::uint32_t kEnd = 0xfffffffeU;

  const Cell* find(std::uint64_t key) const;
  Cell& find_or_add(std::uint64_t key);
  void grow();

  static constexpr int kLevels = 33;
  std::uint64_t levels_ = 0;  ///< Bit l: cells of 2^l steps are in use.
  LatticeBox bounds_;         ///< Of all balls.
  std::vector<Ball> balls_;
  std::vector<Link> links_;
  std::vector<Cell> table_;  ///< Open addressing.
  std::size_t used_ = 0;
};

}  // namespace arris::tiling
