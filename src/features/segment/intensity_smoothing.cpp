#include "features/segment/intensity_smoothing.h"

#include <algorithm>
#include <array>

#include "core/parallel.h"

namespace arris {
namespace {

constexpr std::size_t kGrain = 4096;

std::uint8_t median_intensity(const TileNeighbourhoods& points, std::span<const std::uint8_t> intensities,
                              std::uint32_t slot) {
  std::array<std::uint8_t, kMostNeighbours + 1> values;
  std::size_t count = 0;
  std::uint8_t least = 255, most = 0;
  const auto take = [&](std::uint8_t value) {
    values[count++] = value;
    least = std::min(least, value);
    most = std::max(most, value);
  };
  take(intensities[slot]);
  for (const std::uint32_t neighbour : points.neighbours(slot)) take(intensities[neighbour]);
  if (least == most) return least;
  const auto middle = values.begin() + count / 2;
  std::nth_element(values.begin(), middle, values.begin() + count);
  return *middle;
}

}  // namespace

std::vector<std::uint8_t> smoothed_intensities(const TileNeighbourhoods& points,
                                               std::span<const std::uint8_t> intensities) {
  std::vector<std::uint8_t> smooth(intensities.begin(), intensities.end());
  parallel_for_chunks(smooth.size(), kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto slot = static_cast<std::uint32_t>(i);
      if (points.state(slot) == ShapeState::kShaped) smooth[slot] = median_intensity(points, intensities, slot);
    }
  });
  return smooth;
}

}  // namespace arris
