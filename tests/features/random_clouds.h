#pragma once
/// @file Random small clouds of the shapes that scans, grids and accidents produce.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/tile_points.h"

namespace arris::test {

enum class Shape {
  kPlane,        ///< Noisy plane, random normal.
  kFold,         ///< Two noisy half planes.
  kGrid,         ///< Exact square grid on a plane z = 0: ties everywhere.
  kGridFold,     ///< Two exact grids at a right angle.
  kVolume,       ///< Random points in a box.
  kCollinear,    ///< Points on a line.
  kTwoLayers,    ///< Two parallel planes.
  kDensityStep,  ///< A hundred times denser on one side.
  kClusters,     ///< Far apart clusters and single points.
  kLast = kClusters
};
std::string name(Shape shape);

/// About `points` points with extents of roughly `extent` lattice steps around the origin; some positions are drawn
/// twice.
std::vector<LatticePoint> random_positions(Shape shape, std::size_t points, double extent, std::uint64_t seed);

/// Folds duplicates; ids are shuffled numbers. The tile owns and covers everything.
TilePoints tile_of(std::span<const LatticePoint> positions, std::uint64_t seed);
TilePoints tile_of(const std::vector<LatticePoint>& positions, std::uint64_t seed);

/// All of the lattice and beyond, so that points at its very ends are as well covered as others.
LatticeBox everything();

}  // namespace arris::test
