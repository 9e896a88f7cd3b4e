#pragma once
/// @file Points too far apart for a grid of voxels, as a list in a grid: 24 bytes a point wherever they are.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "tiling/leaf_points.h"
#include "tiling/point_grid.h"

namespace arris::tiling {

/// Full leaves side by side, in Z-order of the points. A point is the attributes "lattice" (three int32) and "id";
/// where the leaf stands, and "P", mean nothing. Memory on top: 4 bytes per point while they are made.
std::vector<std::unique_ptr<PointLeaf>> list_scattered_points(std::span<const LatticePoint> positions,
                                                              std::span<const std::uint64_t> ids);

/// Whether a leaf is of such a list.
bool lists_scattered_points(const PointLeaf& leaf);

/// The points of such leaves, which are emptied on the way.
/// @param leaves  all those of a tree, in any order.
/// @param wanted  as of read_point_grid, asked for the box around the points of a leaf.
SortedPoints take_scattered_points(std::vector<PointLeaf*> leaves,
                                   const std::function<bool(const LatticeBox&)>& wanted);

}  // namespace arris::tiling
