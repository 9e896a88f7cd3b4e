#pragma once
/// @file The tree in which CellGrid keeps its counts. Private to it: includes OpenVDB.

#include <openvdb/tree/InternalNode.h>
#include <openvdb/tree/LeafNode.h>
#include <openvdb/tree/RootNode.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/lattice.h"

namespace arris::tiling {

// Small upper nodes: with OpenVDB's usual 5-4-3 tree every far-away outlier costs 300 kB of internal nodes, here 0.6
// kB. The root without OpenVDB's Tree around it, whose virtual functions are all compiled wherever one is made:
// reading, writing, printing and counting by many threads, which took most of the time that this folder took to
// compile.
using CellLeaf = openvdb::tree::LeafNode<openvdb::Int32, 3>;
using CellTree = openvdb::tree::RootNode<openvdb::tree::InternalNode<CellLeaf, 2>>;
using Cell = std::array<std::int32_t, 3>;

constexpr int kCellLeafLog2 = 3;
/// Coarsest level: a cell is 2^level steps long.
constexpr int kMaxCellLevel = 30;

inline openvdb::Index offset_in_leaf(std::int32_t x, std::int32_t y, std::int32_t z) {
  return static_cast<openvdb::Index>(((x & 7) << 6) | ((y & 7) << 3) | (z & 7));
}

inline LatticeBox cell_box(const Cell& cell, int level) {
  LatticeBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::int64_t{cell[axis]} * (std::int64_t{1} << level);
    box.max[axis] = box.min[axis] + (std::int64_t{1} << level);
  }
  return box;
}

inline Cell cell_of(const LatticePoint& p, int level) {
  return {p.x >> level, p.y >> level, p.z >> level};
}

/// Where the run of points of the same cell ends that starts at `begin`: scans mostly stay in a cell for a while.
inline std::size_t end_of_run(std::span<const LatticePoint> points, std::size_t begin, int level) {
  const Cell cell = cell_of(points[begin], level);
  std::size_t end = begin + 1;
  while (end < points.size() && cell_of(points[end], level) == cell) ++end;
  return end;
}

}  // namespace arris::tiling
