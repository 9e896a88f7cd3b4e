#include "features/segment/likeness.h"

#include "features/numerics/exact_math.h"

namespace arris {
Likeness::Likeness(const TileNeighbourhoods& points, std::span<const std::uint8_t> intensities,
                   const SegmentParameters& parameters)
    : points_(points),
      intensities_(intensities),
      least_alignment_(cosine(parameters.angle_deg / kDegreesPerRadian)),
      step_(parameters.least_intensity_step()) {}

}  // namespace arris
