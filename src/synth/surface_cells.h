#pragma once
/// @file The cells that points are laid into, one point per cell on average. Private to synth.

#include <cstdint>
#include <utility>

#include "synth/face.h"

namespace arris::synth {

/// One row of cells of a face, round a cylinder or sphere, or of one layer of a volume. u is cut into equal columns.
struct CellRow {
  std::uint64_t key = 0;
  std::uint64_t columns = 1;
  double v_low = 0.0, v_high = 0.0;  ///< Sphere: heights along the axis.
  double w_low = 0.0, w_high = 0.0;  ///< Volume.
  double u_pitch = 0.0;              ///< Width of the cells of a plane that reach beyond it by one; 0: they span it.
  std::uint16_t face_number = 0;
};

/// Of the random numbers of a cell; cells of a row have distinct keys.
inline std::uint64_t cell_key(std::uint64_t row_key, std::uint64_t column) {
  return row_key + column * 0xd1342543de82ef95ULL;  // Odd: distinct columns have distinct keys.
}

/// The place at a height along the axis of a sphere and a share of the turn round it.
Vec3 on_sphere(const Face& face, double turn, double height);

/// @param a, b  place within the cell, [0, 1]. Of a volume: the place on its floor. False if it is not on the face.
std::pair<Vec3, bool> position_of(const Face& face, const CellRow& row, std::uint64_t column, double a, double b);

}  // namespace arris::synth
