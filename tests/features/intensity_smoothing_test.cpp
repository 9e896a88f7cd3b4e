// Smoothed intensities against medians by sorting.

#include "features/segment/intensity_smoothing.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "features/neighbourhood/point_tree.h"
#include "random_clouds.h"

namespace arris {
namespace {

RC_GTEST_PROP(SmoothedIntensities, AreUpperMedians, ()) {
  const auto shape = static_cast<test::Shape>(*rc::gen::inRange(0, static_cast<int>(test::Shape::kLast) + 1));
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const TilePoints tile = test::tile_of(test::random_positions(shape, 300, 1000.0, seed), seed);
  const PointTree tree(tile.positions, tile.ids);
  SegmentParameters parameters;
  parameters.neighbours = static_cast<std::size_t>(*rc::gen::inRange(3, static_cast<int>(kMostNeighbours) + 1));
  parameters.max_radius = *rc::gen::element(0.1, 0.3, 10.0);
  TileNeighbourhoods points(tree, {0.001, {0.0, 0.0, 0.0}}, parameters);
  points.compute(std::vector<std::uint8_t>(tree.size(), 1));
  const auto values = *rc::gen::container<std::vector<std::uint8_t>>(tree.size(), rc::gen::arbitrary<std::uint8_t>());
  const PageVector<std::uint8_t> smooth = smoothed_intensities(points, values);
  for (std::uint32_t slot = 0; slot < tree.size(); ++slot) {
    std::vector<std::uint8_t> around{values[slot]};
    for (const std::uint32_t neighbour : points.neighbours(slot)) around.push_back(values[neighbour]);
    std::sort(around.begin(), around.end());
    RC_ASSERT(smooth[slot] == (points.state(slot) == ShapeState::kShaped ? around[around.size() / 2] : values[slot]));
  }
}

}  // namespace
}  // namespace arris
