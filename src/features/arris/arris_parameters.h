#pragma once
/// @file Parameters of arris's own method (docs/methods-arris.md). None has to be set.

#include <array>
#include <cstdint>

namespace arris {

/// Lengths in data units.
struct ArrisParameters {
  double spacing = 0.0;     ///< > 0: one point spacing for all points; 0: estimated per point.
  double max_radius = 0.0;  ///< R_max > 0: points beyond it are not looked at. Resolved before any tile is run.
  double min_score = 0.3;   ///< Contour points with a lower EdgeScore are dropped; [0, 1].
  bool boundary = true;     ///< Look for boundaries.
  bool fold = true;         ///< Look for folds.
  bool thin = false;        ///< Keep one chain of points along a contour instead of all within a spacing of it.
  /// From where the scene is seen, which tells convex folds from concave ones.
  enum class View : std::uint8_t { kAbove, kPoint, kNone } view = View::kAbove;
  std::array<double, 3> viewpoint{0.0, 0.0, 0.0};  ///< For kPoint: world coordinates.
};

/// Throws ConfigError, naming the option, if a value is outside its range (max_radius must be resolved, > 0).
void validate(const ArrisParameters& parameters);

}  // namespace arris
