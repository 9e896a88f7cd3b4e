#pragma once
/// @file Lattice points and ids as an OpenVDB PointDataGrid in a stream, and back, without loss.

#include <cstdint>
#include <functional>
#include <istream>
#include <map>
#include <memory>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "core/lattice.h"
#include "core/tile_points.h"

namespace arris::tiling {

/// Points as they come back from a grid: in Z-order of positions (morton.h), equal positions by ascending id.
struct SortedPoints {
  LatticePoints positions;
  PointIds ids;
};

class StoredGrid;

/// A grid "points" with the attributes "P" and "id" (int64), whose world space is lattice steps. It is written when
/// asked, so that the caller may drop its points first. Storage voxels are 2^v steps: v is the smallest for which a
/// leaf of 8^3 voxels holds kPointsPerLeaf points on average, 13 at most. Positions are 16-bit fixed point (an error
/// below voxel / 65535 cannot leave a step). Clouds so scattered that leaves and the nodes above them would take more
/// memory than their points are listed instead (scattered_points.h).
///
/// Peak memory while it is made: tile_store.h, build_bytes. Runs in parallel (core/parallel.h).
class PointGrid {
 public:
  static constexpr std::size_t kPointsPerLeaf = 500;

  /// Equal lengths; at most 2^32 - 2 points (ConfigError). ids below 2^63.
  PointGrid(std::span<const LatticePoint> positions, std::span<const std::uint64_t> ids,
            const std::map<std::string, std::string>& metadata);
  ~PointGrid();
  PointGrid(const PointGrid&) = delete;
  PointGrid& operator=(const PointGrid&) = delete;

  void write(std::ostream& stream) const;
  /// The points, sorted as if they were read back; what the grid keeps of them is freed on the way.
  SortedPoints take_points() &&;

 private:
  std::unique_ptr<StoredGrid> stored_;
};

/// Reads what PointGrid::write wrote. Throws std::exception of some kind for anything else; the
/// caller verifies a checksum first.
/// @param wanted  leaves for whose box this is false are left out; null: all are read.
SortedPoints read_point_grid(std::istream& stream, const std::function<bool(const LatticeBox&)>& wanted = {});

/// Does what the first grid would have to wait for (a program may have to load OpenVDB), on a thread of its own if
/// there may be any, and is through with it when it ends: a program must not end meanwhile. Need not be used.
class PointGridPreparation {
 public:
  PointGridPreparation();
  ~PointGridPreparation();
  PointGridPreparation(const PointGridPreparation&) = delete;
  PointGridPreparation& operator=(const PointGridPreparation&) = delete;
};
/// Memory that the process will take for that, on top of what is resident; 0 if it has it: waits if it has begun.
/// Throws IoError if OpenVDB cannot be loaded.
std::uint64_t point_grid_bytes_to_come();

}  // namespace arris::tiling
