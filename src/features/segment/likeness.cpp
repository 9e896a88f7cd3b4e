#include "features/segment/likeness.h"

#include "features/numerics/exact_math.h"

namespace arris {
namespace {

/// cos x for x in [0, pi / 2] by its series: the C library's own may differ from machine to machine.
double cosine(double x) {
  double sum = 0.0;
  for (int n = 24; n >= 2; n -= 2) sum = x * x / (n * (n - 1)) * (1.0 - sum);
  return 1.0 - sum;
}

}  // namespace

Likeness::Likeness(const TileNeighbourhoods& points, std::span<const std::uint8_t> intensities,
                   const SegmentParameters& parameters)
    : points_(points),
      intensities_(intensities),
      least_alignment_(cosine(parameters.angle_deg / kDegreesPerRadian)),
      step_(parameters.least_intensity_step()) {}

}  // namespace arris
