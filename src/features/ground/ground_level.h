#pragma once
/// @file One level of the pyramid of a ground model.

#include <array>
#include <bitset>
#include <cstdint>
#include <functional>

#include "features/ground/ground_blocks.h"

namespace arris {

/// Mean of the ground points of a cell.
struct GroundMean {
  float dx = 0.0F, dy = 0.0F;  ///< From the centre of the cell, in its sides: -0.5 to 0.5.
  double z = 0.0;
  double count = 0.0;  ///< 0: no points, and nothing of the above.
};
using GroundMeans = std::array<GroundMean, kGroundBlockCells>;

/// Means of the cells of twice the side: those of four cells are added in one order, whatever that of the blocks.
GroundBlocks<GroundMeans> coarser_means(const GroundBlocks<GroundMeans>& means);

/// Where there is ground: coordinates from the lowest to the highest centre of a cell with points.
struct GroundBounds {
  double low_x = 0.0, low_y = 0.0, high_x = 0.0, high_y = 0.0;
  bool contains(double x, double y) const { return x >= low_x && x <= high_x && y >= low_y && y <= high_y; }
};

/// Heights at the centres of square cells of one size, in the blocks that hold ground points, and between the centres
/// bilinear interpolation.
class GroundLevel {
 public:
  /// A surface that is known already: the next coarser level and those above.
  using Surface = std::function<double(double x, double y)>;

  /// Cells with points get the height of their mean, carried to the centre along the slope of `coarse` (1 at most);
  /// where there are none, the heights solve Laplace's equation between them as well as a number of sweeps can that
  /// start from `coarse`. Around the blocks the surface is `coarse` within the bounds, and out of the bounds it is
  /// level.
  GroundLevel(double cell_size, const GroundBlocks<GroundMeans>& means, const GroundBounds& bounds, int sweeps,
              const Surface& coarse);

  /// False, and `height` stays, if the position lies in none of the blocks. Thread-safe.
  bool height_at(double x, double y, double& height) const;
  std::size_t blocks() const { return blocks_.size(); }

 private:
  static constexpr int kSide = kGroundBlockSide + 2;  ///< With a ring of the neighbours' cells.
  struct Heights {
    std::array<double, static_cast<std::size_t>(kSide* kSide)> at;
    std::bitset<kGroundBlockCells> known;
  };
  static std::size_t index(int i, int j) { return static_cast<std::size_t>((j + 1) * kSide + i + 1); }

  double centre(std::int32_t block, int i) const {
    return (static_cast<double>(block) * kGroundBlockSide + i + 0.5) * cell_size_;
  }
  double carried(const GroundMean& mean, double at_centre, double x, double y, const Surface& coarse) const;
  void start(const GroundBlockKey& key, const GroundMeans& means, const Surface& coarse);
  void exchange_rings(const GroundBounds& bounds);
  void sweep();

  double cell_size_;
  GroundBlocks<Heights> blocks_;
};

}  // namespace arris
