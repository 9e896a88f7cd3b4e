#include "features/segment/growing_points.h"

#include <array>
#include <cmath>

#include "core/parallel.h"

namespace arris {
namespace {

constexpr std::size_t kGrain = 4096;

/// Whether a share of its neighbours is like the point.
class Agreement {
 public:
  Agreement(const TileNeighbourhoods& points, const Likeness& likeness, double share)
      : points_(points), likeness_(likeness) {
    for (std::size_t count = 0; count < needed_.size(); ++count)
      needed_[count] = static_cast<std::size_t>(std::ceil(share * static_cast<double>(count)));
  }

  /// Most points agree with the first that are looked at: neighbours are read one by one.
  bool operator()(std::uint32_t slot) const {
    const std::size_t needed = needed_[points_.count(slot)];
    if (needed == 0) return true;
    const Likeness::With point(likeness_, slot);
    std::size_t like = 0;
    points_.visit_neighbours(slot, [&](std::uint32_t neighbour) {
      like += points_.state(neighbour) == ShapeState::kShaped && point.alike(neighbour);
      return like < needed;
    });
    return like == needed;
  }

 private:
  const TileNeighbourhoods& points_;
  const Likeness& likeness_;
  std::array<std::size_t, kMostNeighbours + 1> needed_{};  ///< Of so many neighbours.
};

}  // namespace

PageVector<std::uint8_t> growing_points(const TileNeighbourhoods& points, const QueryRings& rings,
                                        const Likeness& likeness, const SegmentParameters& parameters) {
  const Agreement agrees(points, likeness, parameters.least_agreement());
  const auto most_variation = static_cast<float>(parameters.curvature);
  PageVector<std::uint8_t> grows(points.size(), 0);
  parallel_for_chunks(grows.size(), kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto slot = static_cast<std::uint32_t>(i);
      if (!rings.within(slot, 1) || points.state(slot) != ShapeState::kShaped) continue;
      if (!(points.shape(slot).variation < most_variation)) continue;
      grows[slot] = parameters.published || agrees(slot);
    }
  });
  return grows;
}

}  // namespace arris
