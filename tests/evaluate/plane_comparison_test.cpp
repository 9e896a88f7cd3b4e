#include "evaluate/plane_comparison.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "core/error.h"
#include "evaluate/segmentation_text.h"
#include "random_labels.h"

namespace arris::evaluate {
namespace {

/// `count` points with these labels; where they lie does not matter.
void add(std::vector<LabelledPoint>& points, std::uint32_t segment, std::uint32_t face, int count) {
  points.insert(points.end(), static_cast<std::size_t>(count), {{0, 0, 0}, segment, face});
}

/// Plane 1 whole but for 10 points, plane 2 cut in two halves, planes 3 and 4 in one segment, plane 5 not found;
/// segment 7 holds half of its points in a tree, segment 9 is a tree.
std::vector<LabelledPoint> roofs() {
  std::vector<LabelledPoint> points;
  add(points, 1, 1, 90);
  add(points, 0, 1, 10);
  add(points, 2, 2, 50);
  add(points, 3, 2, 50);
  add(points, 4, 3, 40);
  add(points, 4, 4, 60);
  add(points, 0, 5, 30);
  add(points, 7, 6, 20);
  add(points, 7, 0, 20);
  add(points, 9, 0, 5);
  add(points, 0, 0, 75);
  return points;
}

TEST(PlaneComparison_OfARoofscape, IsThatCountedByHand) {
  const PlaneComparison c = compare_planes(roofs(), {0.5, 12.5});
  EXPECT_EQ(c.points, 350U);
  EXPECT_EQ(c.points_unsegmented, 40U);
  EXPECT_EQ(c.strays, 100U);
  EXPECT_EQ(c.strays_unsegmented, 75U);
  EXPECT_EQ(c.all.planes, 6U);
  EXPECT_EQ(c.all.planes_found, 5U);
  EXPECT_EQ(c.all.segments, 6U);
  EXPECT_EQ(c.all.segments_right, 5U);  // All but the tree; half is enough.
  EXPECT_EQ(c.all.quality, 5.0 / 7.0);
  EXPECT_NEAR(*c.all.completeness, (0.9 + 0.5 + 1 + 1 + 0 + 1) / 6, 1e-12);
  EXPECT_NEAR(*c.all.correctness, (1 + 1 + 0.4 + 0.6 + 0.5) / 5, 1e-12);
  EXPECT_NEAR(*c.all.iou, (0.9 + 0.5 + 0.4 + 0.6 + 0 + 0.5) / 6, 1e-12);
  EXPECT_EQ(c.all.relations, (PlaneRelations{2, 1, 1, 0, 1, 1}));
  ASSERT_EQ(c.matches.size(), 6U);
  EXPECT_EQ(c.matches[2].segment, 4U);
  EXPECT_EQ(c.matches[4].segment, 0U);
  EXPECT_EQ(c.matches[4].correctness(), std::nullopt);
  EXPECT_EQ(c.matches[5].segment_points, 40U);
}

TEST(PlaneComparison_LargeOnes, AreThoseOfTheLeastArea) {
  const PlaneComparison c = compare_planes(roofs(), {0.5, 12.5});  // 50 points.
  EXPECT_EQ(c.large.planes, 3U);
  EXPECT_EQ(c.large.planes_found, 3U);
  EXPECT_EQ(c.large.segments, 4U);
  EXPECT_EQ(c.large.segments_right, 4U);
  EXPECT_NEAR(*c.large.completeness, (0.9 + 0.5 + 1) / 3, 1e-12);
  // Plane 3 is too small to be counted, but segment 4 holds it all the same.
  EXPECT_NEAR(*c.large.correctness, (1 + 1 + 0.6) / 3, 1e-12);
  EXPECT_EQ(c.large.relations, (PlaneRelations{2, 1, 0, 0, 0, 0}));
  EXPECT_EQ(compare_planes(roofs(), {0.5, 15.1}).large.planes, 2U);
  EXPECT_EQ(compare_planes(roofs(), {0.5, 0.0}).large.planes, 6U);
}

TEST(PlaneComparison_APlaneSplitAndJoined, IsManyToMany) {
  std::vector<LabelledPoint> points;
  add(points, 1, 1, 50);
  add(points, 2, 1, 50);
  add(points, 2, 2, 40);
  EXPECT_EQ(compare_planes(points, {1, 0}).all.relations, (PlaneRelations{0, 0, 0, 1, 0, 0}));
}

TEST(PlaneComparison_OfAPerfectSegmentation, IsTheBest) {
  std::vector<LabelledPoint> points;
  add(points, 5, 1, 30);
  add(points, 3, 8, 20);
  add(points, 0, 0, 10);
  const PlaneComparison c = compare_planes(points, {1, 25});
  for (const PlaneFigures& f : {c.all, c.large}) {
    EXPECT_EQ(f.found_rate, 1.0);
    EXPECT_EQ(f.right_rate, 1.0);
    EXPECT_EQ(f.quality, 1.0);
    EXPECT_EQ(f.completeness, 1.0);
    EXPECT_EQ(f.correctness, 1.0);
    EXPECT_EQ(f.iou, 1.0);
  }
  EXPECT_EQ(c.adjusted_rand, 1.0);
}

TEST(PlaneComparison_OfNothing, IsUndefined) {
  const PlaneComparison c = compare_planes({}, {1, 10});
  EXPECT_FALSE(c.all.found_rate || c.all.right_rate || c.all.quality || c.all.completeness || c.all.correctness ||
               c.all.iou || c.adjusted_rand);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<LabelledPoint> nowhere{{{nan, 0, 0}, 1, 1}};
  EXPECT_EQ(compare_planes(nowhere, {1, 10}).all.planes, 0U);
  EXPECT_THROW(compare_planes({}, {0, 10}), ConfigError);
  EXPECT_THROW(compare_planes({}, {nan, 10}), ConfigError);
  EXPECT_THROW(compare_planes({}, {1, -1}), ConfigError);
}

/// Connected components by walking from every plane and segment, point by point.
PlaneRelations relations_by_walks(const std::map<std::uint32_t, std::map<std::uint32_t, int>>& counts,
                                  const std::map<std::uint32_t, int>& planes,
                                  const std::map<std::uint32_t, int>& segments) {
  using Node = std::pair<bool, std::uint32_t>;  // True for planes.
  std::map<Node, std::set<Node>> neighbours;
  for (const auto& [face, size] : planes) neighbours[{true, face}];
  for (const auto& [segment, size] : segments) neighbours[{false, segment}];
  for (const auto& [face, face_size] : planes) {
    for (const auto& [segment, segment_size] : segments) {
      const int common = counts.count(face) && counts.at(face).count(segment) ? counts.at(face).at(segment) : 0;
      if (common < 0.5 * face_size && common < 0.5 * segment_size) continue;
      neighbours[{true, face}].insert({false, segment});
      neighbours[{false, segment}].insert({true, face});
    }
  }
  PlaneRelations result;
  std::set<Node> done;
  for (const auto& [start, unused] : neighbours) {
    if (done.count(start)) continue;
    std::vector<Node> waiting{start};
    std::size_t n = 0, m = 0;
    while (!waiting.empty()) {
      const Node node = waiting.back();
      waiting.pop_back();
      if (!done.insert(node).second) continue;
      ++(node.first ? n : m);
      for (const Node& next : neighbours[node]) waiting.push_back(next);
    }
    ++(m == 0           ? result.planes_alone
       : n == 0         ? result.segments_alone
       : n > 1 && m > 1 ? result.many_to_many
       : n > 1          ? result.many_to_one
       : m > 1          ? result.one_to_many
                        : result.one_to_one);
  }
  return result;
}

RC_GTEST_PROP(PlaneComparison_OfRandomClouds, FollowsItsDefinitions, ()) {
  const auto points = *any_labelled_cloud();
  const int least = *rc::gen::inRange(0, 12);
  const PlaneComparison c = compare_planes(points, {0.5, 0.25 * least});
  std::map<std::uint32_t, std::map<std::uint32_t, int>> counts;  // By face and segment, without 0.
  std::map<std::uint32_t, int> planes, segments;
  for (const LabelledPoint& p : points) {
    if (p.face != 0) ++planes[p.face];
    if (p.segment != 0) ++segments[p.segment];
    if (p.face != 0 && p.segment != 0) ++counts[p.face][p.segment];
  }
  std::size_t n = 0, found = 0, right = 0, m = 0, with_segment = 0;
  double completeness = 0, correctness = 0, iou = 0;
  for (const auto& [face, size] : planes) {
    if (size < least) continue;
    ++n;
    int common = 0, own = 0;
    for (const auto& [segment, count] : counts[face]) {
      if (count > common || (count == common && segments[segment] < own)) {
        common = count;
        own = segments[segment];
      }
    }
    found += 2 * common >= size ? 1 : 0;
    completeness += double(common) / size;
    iou += double(common) / (size + own - common);
    correctness += own > 0 ? double(common) / own : 0.0;
    with_segment += own > 0 ? 1 : 0;
  }
  for (const auto& [segment, size] : segments) {
    if (size < least) continue;
    ++m;
    int most = 0;
    for (auto& [face, by_segment] : counts) most = std::max(most, by_segment[segment]);
    right += 2 * most >= size ? 1 : 0;
  }
  RC_ASSERT(c.large.planes == n && c.large.planes_found == found);
  RC_ASSERT(c.large.segments == m && c.large.segments_right == right);
  if (n > 0) RC_ASSERT(std::abs(*c.large.completeness - completeness / double(n)) < 1e-12);
  if (n > 0) RC_ASSERT(std::abs(*c.large.iou - iou / double(n)) < 1e-12);
  if (with_segment > 0) RC_ASSERT(std::abs(*c.large.correctness - correctness / double(with_segment)) < 1e-12);
  RC_ASSERT(c.all.relations == relations_by_walks(counts, planes, segments));
  std::erase_if(planes, [&](const auto& item) { return item.second < least; });
  std::erase_if(segments, [&](const auto& item) { return item.second < least; });
  RC_ASSERT(c.large.relations == relations_by_walks(counts, planes, segments));
}

TEST(PlaneText_OfAComparison, SaysTheSameInEveryFormat) {
  SegmentationOptions options;
  options.spacing = 0.5;
  options.min_plane_area = 12.5;
  const SegmentationComparison c = compare_segmentation(roofs(), options);
  const auto json = nlohmann::json::parse(to_json(c))["planes"];
  EXPECT_EQ(json["all"]["planes_found"], 5);
  EXPECT_EQ(json["large"]["one_to_many"], 1);
  EXPECT_EQ(json["strays_unsegmented_share"], 0.75);
  EXPECT_EQ(json["matches"].size(), 6U);
  EXPECT_TRUE(json["matches"][4]["correctness"].is_null());
  std::istringstream csv(to_csv(c));
  std::string names, line;
  std::getline(csv, names);
  EXPECT_NE(names.find(",plane_large_completeness,"), std::string::npos) << names;
  while (std::getline(csv, line)) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(names.begin(), names.end(), ','));
  }
  const std::string table = to_table(c);
  EXPECT_NE(table.find("5 / 6"), std::string::npos) << table;
  EXPECT_NE(table.find("1:1 2, 1:M 1, N:1 1, N:M 0, planes alone 1, segments alone 1"), std::string::npos) << table;
  options.min_plane_area.reset();
  EXPECT_EQ(to_json(compare_segmentation(roofs(), options)).find("planes"), std::string::npos);
}

}  // namespace
}  // namespace arris::evaluate
