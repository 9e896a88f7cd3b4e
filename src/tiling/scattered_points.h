#pragma once
/// @file Points too far apart for a grid of voxels, as a list in a grid: 24 bytes a point wherever they are.

#include <openvdb/points/PointDataGrid.h>

#include <cstdint>
#include <functional>
#include <span>

#include "core/lattice.h"
#include "tiling/point_grid.h"

namespace arris::tiling {

/// A tree of full leaves side by side, in Z-order of the points. A point is the attributes "lattice" (three int32) and
/// "id"; where the leaf stands, and "P", mean nothing. Memory on top: 4 bytes per point while it is made.
openvdb::points::PointDataTree::Ptr list_scattered_points(std::span<const LatticePoint> positions,
                                                          std::span<const std::uint64_t> ids);

bool lists_scattered_points(const openvdb::points::PointDataTree& tree);

/// The points of such a tree, which is emptied on the way.
/// @param wanted  as of read_point_grid, asked for the box around the points of a leaf.
SortedPoints take_scattered_points(openvdb::points::PointDataTree& tree,
                                   const std::function<bool(const LatticeBox&)>& wanted);

}  // namespace arris::tiling
