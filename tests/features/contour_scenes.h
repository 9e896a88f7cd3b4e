#pragma once
/// @file Small analytic scenes with known contours, and the score of detections against them.

#include <array>
#include <cstdint>
#include <vector>

#include "core/tile_points.h"
#include "features/contour/contour_record.h"

namespace arris::test {

using Point = std::array<double, 3>;

struct Scene {
  std::vector<Point> points;
  std::vector<std::uint32_t> faces;  ///< Number of the surface that each point was sampled from.
  std::vector<Point> truth;          ///< Contours, sampled every half spacing.
  double spacing = 0.0;
};

/// How a surface is sampled.
struct Sampling {
  double spacing = 0.25;
  double noise = 0.0;   ///< Standard deviation of isotropic Gaussian noise, in spacings.
  bool random = false;  ///< Uniformly random instead of a jittered grid.
  double jitter = 0.5;  ///< Of the grid, in all, spacings.
  std::uint64_t seed = 1;
};

/// Liu's Block: a box of 24 x 24 x 12 m with a closed cylinder of 14 m diameter and 6 m height above and below.
/// Contours: the twelve edges of the box, two concave circles where cylinder and box meet, two rims.
Scene block_scene(const Sampling& sampling);

/// Two parallel square plates of 60 x 60 spacings with a round hole, `gap` spacings apart. Contours: all borders.
Scene plates_scene(const Sampling& sampling, double gap);

/// A tile that owns all points of the scene, on a lattice of `step`; ids are the indices of points.
TilePoints tile_of(const Scene& scene, double step);

struct Score {
  double precision = 0.0;
  double recall = 0.0;
  double f1() const { return precision + recall > 0.0 ? 2.0 * precision * recall / (precision + recall) : 0.0; }
};

/// Liu's protocol: a detection is right if a contour is within `tolerance`; recall is the share of contour samples with
/// a detection within it. `classes` selects records.
Score score(const Scene& scene, const ContourRecords& records, std::uint8_t classes, double tolerance);

}  // namespace arris::test
