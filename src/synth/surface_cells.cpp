#include "synth/surface_cells.h"

#include <algorithm>
#include <cmath>

#include "synth/deterministic_math.h"

namespace arris::synth {

Vec3 on_sphere(const Face& face, double turn, double height) {
  const double around = std::sqrt(std::max(0.0, face.radius * face.radius - height * height));
  const SinCos angle = sin_cos_turns(turn);
  return face.origin + around * angle.cos * face.eu + around * angle.sin * face.ev + height * face.ew;
}

std::pair<Vec3, bool> position_of(const Face& face, const CellRow& row, std::uint64_t column, double a, double b) {
  const double turn = (static_cast<double>(column) + a) / static_cast<double>(row.columns);
  const double v = row.v_low + b * (row.v_high - row.v_low);
  switch (face.shape) {
    case Face::Shape::kPlane: {
      const double u = row.u_pitch > 0.0 ? (static_cast<double>(column) + a - 1.0) * row.u_pitch : turn * face.size_u;
      return {face.at(u, v), face.owns(u, v)};
    }
    case Face::Shape::kCylinder: {
      const SinCos angle = sin_cos_turns(turn * face.sweep_turns);
      return {face.origin + face.radius * angle.cos * face.eu + face.radius * angle.sin * face.ev + v * face.ew,
              v >= 0.0 && v <= face.size_v};
    }
    case Face::Shape::kSphere:
      return {on_sphere(face, turn, v), v >= face.cap_height};
    case Face::Shape::kVolume:
      break;
  }
  return {face.at(turn * face.size_u, v), true};
}

}  // namespace arris::synth
