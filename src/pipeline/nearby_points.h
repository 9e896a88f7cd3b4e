#pragma once
/// @file Points of many tiles around queries that ask for a wider view.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/tile_points.h"
#include "tiling/point_grid.h"
#include "tiling/query_regions.h"

namespace arris::pipeline {

/// What was read of the tiles once, to be looked at for one group of queries after the other. Memory: 20 bytes per
/// point.
class NearbyPoints {
 public:
  static constexpr std::size_t kBytesPerPoint = 20;

  /// @param tiles  the points of each, in Z-order. Runs in parallel.
  explicit NearbyPoints(std::vector<tiling::SortedPoints>&& tiles);

  std::size_t size() const { return size_; }
  /// Those in the regions, duplicates folded, with core and covered box unlimited: queries look no farther than their
  /// regions. None if there are more than most_points. Runs in parallel.
  std::optional<TilePoints> in(const tiling::QueryRegions& regions, std::uint64_t most_points) const;

 private:
  struct Tile {
    Tile() = default;
    explicit Tile(tiling::SortedPoints&& of_tile);
    tiling::SortedPoints points;
    std::vector<LatticeBox> blocks;  ///< Of kBlockPoints points each.
  };
  static constexpr std::size_t kBlockPoints = 256;

  std::vector<Tile> tiles_;
  std::size_t size_ = 0;
};

}  // namespace arris::pipeline
