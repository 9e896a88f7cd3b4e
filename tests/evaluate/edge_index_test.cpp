#include "evaluate/edge_index.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "random_edges.h"

namespace arris::evaluate {
namespace {

RC_GTEST_PROP(EdgeIndex_Nearest, AnyPointAndEdges_EqualsBruteForce, ()) {
  const auto edges = *rc::gen::container<std::vector<TruthEdge>>(any_edge());
  const auto points = *rc::gen::container<std::vector<Vec3>>(position());
  std::vector<double> units;
  for (std::size_t i = 0; i < edges.size(); ++i) units.push_back(*rc::gen::element(0.01, 0.3, 1.0, 1.5, 70.0));
  const EdgeIndex index(edges, units);
  for (const Vec3& point : points) {
    EdgeIndex::Nearest expected;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const double distance = edges[i].distance(point) / units[i];
      if (distance < expected.distance) expected = {i, distance};
    }
    const EdgeIndex::Nearest found = index.nearest(point);
    RC_ASSERT(found.distance == expected.distance);
    RC_ASSERT(found.edge == expected.edge);
  }
}

TEST(EdgeIndex_Nearest, NothingWithinTheLimit_IsInfinite) {
  const EdgeIndex index({make_segment(EdgeKind::kConvex, "", {0, 0, 0}, {1, 0, 0}, 90.0)});
  EXPECT_TRUE(std::isinf(index.nearest({0, 2, 0}, 1.5).distance));
  EXPECT_DOUBLE_EQ(index.nearest({0, 2, 0}, 2.5).distance, 2.0);
}

}  // namespace
}  // namespace arris::evaluate
