#pragma once
/// @file A LAS scale and offset for coordinates that have none.

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "io/point_writer.h"

namespace arris::io {

/// Scaled integers: stored = round((world - offset) / scale).
struct LasGrid {
  std::array<double, 3> scale{0.0001, 0.0001, 0.0001};
  std::array<double, 3> offset{0.0, 0.0, 0.0};

  /// Nothing if the value is not finite or does not fit.
  std::optional<std::int32_t> stored(std::size_t axis, double world) const {
    const double steps = std::round((world - offset[axis]) / scale[axis]);
    if (!(steps >= -2147483648.0 && steps <= 2147483647.0)) return std::nullopt;
    return static_cast<std::int32_t>(steps);
  }
};

/// Scale 0.0001 where that is a sensible resolution, otherwise another power of ten: finer where the longest side is
/// below 10 units (keeping at least 10^5 steps over it), coarser where int32 would not hold the extent. The offset is
/// the whole number nearest to the middle, or 0 where coordinates stay below 1000. Throws ConfigError if no scale up to
/// 10^6 fits.
LasGrid choose_las_grid(const WorldExtent& extent);

/// A grid for inputs of different scales and offsets: per axis the finest scale, and the offset of the first LAS input.
/// An offset moves to the middle where int32 would not reach the extent from it; where no offset does, or no input is
/// LAS, the grid is choose_las_grid()'s. With PLY inputs among them, an axis on which choose_las_grid() has finer steps
/// takes these.
LasGrid merge_las_grids(const std::vector<SourceInfo>& inputs, const WorldExtent& extent);

}  // namespace arris::io
