#include "synth/scene_measure.h"

#include <algorithm>

#include "synth/deterministic_math.h"
#include "synth/surface_cells.h"

namespace arris::synth {
namespace {

constexpr double kSparsestFactor = 3.1622776601683795;  // Spacing at the sparse end of a gradient: density 10:1.

/// At a place `t` in [0, 1] along the gradient.
double gradient_share(double t) {
  const double factor = 1.0 + (kSparsestFactor - 1.0) * std::clamp(t, 0.0, 1.0);
  return 1.0 / (factor * factor);
}

/// Mean share of the density over the face, by the midpoint rule on a fixed raster.
double mean_share(const Face& face, const Box3& bounds, Sampling sampling) {
  if (sampling != Sampling::kGradient) return 1.0;
  constexpr int kSteps = 64;
  double sum = 0.0;
  int owned = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double a = (i + 0.5) / kSteps, b = (j + 0.5) / kSteps;
      Vec3 position = face.at(a * face.size_u, b * face.size_v);
      if (face.shape == Face::Shape::kSphere) {
        if ((2.0 * b - 1.0) * face.radius < face.cap_height) continue;
        position = on_sphere(face, a, (2.0 * b - 1.0) * face.radius);
      } else if (face.shape == Face::Shape::kCylinder) {
        const SinCos angle = sin_cos_turns(a * face.sweep_turns);
        position = face.origin + face.radius * angle.cos * face.eu + face.radius * angle.sin * face.ev;
      } else if (face.shape == Face::Shape::kPlane && !face.owns(a * face.size_u, b * face.size_v)) {
        continue;
      }
      sum += gradient_share_at(bounds, position);
      ++owned;
    }
  }
  return owned > 0 ? sum / owned : 1.0;
}

/// What the number of points is proportional to.
double counted_measure(const Face& face) {
  return face.returns > 0.0 ? face.measure() * (face.returns / face.size_w) : face.measure();
}

}  // namespace

double gradient_share_at(const Box3& bounds, const Vec3& position) {
  const double length = bounds.max.x - bounds.min.x;
  return gradient_share(length > 0.0 ? (position.x - bounds.min.x) / length : 0.0);
}

bool is_volume(const SceneModel& model) {
  return !model.faces.empty() && model.faces.front().shape == Face::Shape::kVolume &&
         model.faces.front().returns == 0.0;
}

double weighted_measure(const SceneModel& model, Sampling sampling) {
  const Box3 bounds = model.bounds();
  double sum = 0.0;
  for (const Face& face : model.faces) sum += counted_measure(face) * mean_share(face, bounds, sampling);
  return sum;
}

}  // namespace arris::synth
