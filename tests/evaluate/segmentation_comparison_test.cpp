#include "evaluate/segmentation_comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.h"
#include "evaluate/segment_shapes.h"
#include "evaluate/segmentation_text.h"

namespace arris::evaluate {
namespace {

/// A floor of 20 x 10 points at z = 0 and a wall of 20 x 10 at y = 0 with spacing 0.1, cut into segments 1 m wide.
std::vector<LabelledPoint> corner() {
  std::vector<LabelledPoint> points;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 10; ++j) {
      const std::uint32_t half = i < 10 ? 1 : 2;
      const double x = 0.1 * i, along = 0.1 * j + 0.05;
      points.push_back({{x, along, 0.0}, half, 1});
      points.push_back({{x, 0.0, along}, half + 2, 2});
    }
  }
  return points;
}

SegmentationOptions spacing_of(double spacing) {
  SegmentationOptions options;
  options.spacing = spacing;
  return options;
}

TEST(SegmentationComparison_OfACorner, FindsItsFoldAndCounts) {
  SegmentationOptions options = spacing_of(0.1);
  options.radius = 0.1;
  options.voxel = 0.04;
  const SegmentationComparison c = compare_segmentation(corner(), options);
  EXPECT_EQ(c.judged, 400U);
  EXPECT_EQ(c.left_out, 0U);
  EXPECT_EQ(c.overlaps.segments, 4U);
  EXPECT_EQ(c.overlaps.faces, 2U);
  EXPECT_EQ(c.points_per_segment, 100.0);
  EXPECT_EQ(c.overlaps.undersegmentation, 0.0);
  EXPECT_EQ(c.overlaps.information_split, 1.0);
  EXPECT_EQ(c.truth_boundary, 40U);  // A row on each side of the fold.
  // The same, and two columns of 10 points on each surface, of which one point each is at the fold already.
  EXPECT_EQ(c.segment_boundary, 40U + 2 * 2 * 10 - 4);
  ASSERT_EQ(c.boundaries.size(), 4U);
  EXPECT_NEAR(c.boundaries[0].tolerance, 0.04 * std::sqrt(3.0), 1e-15);
  for (const BoundaryAgreement& row : c.boundaries) EXPECT_EQ(row.recall, 1.0);
  EXPECT_EQ(c.boundaries[1].precision, 44.0 / 76.0);  // The second points of the columns are within 0.1.
}

TEST(SegmentationComparison_Points, WithoutLabels_AreCounted) {
  std::vector<LabelledPoint> points = corner();
  for (std::size_t i = 0; i < 50; ++i) points[2 * i].segment = 0;
  for (std::size_t i = 0; i < 8; ++i) points.push_back({{0.1, 0.1, 0.5}, 77, 0});
  const SegmentationComparison c = compare_segmentation(points, spacing_of(0.1));
  EXPECT_EQ(c.judged, 400U);
  EXPECT_EQ(c.left_out, 8U);
  EXPECT_EQ(c.unsegmented, 50U);
  EXPECT_EQ(c.overlaps.points, 350U);
  EXPECT_EQ(c.radius, 0.2);
}

TEST(SegmentationComparison_Options, ThatCannotBe_AreRefused) {
  const std::vector<LabelledPoint> points = corner();
  EXPECT_THROW(compare_segmentation(points, spacing_of(0.0)), ConfigError);
  SegmentationOptions options = spacing_of(0.1);
  options.voxel = -1.0;
  EXPECT_THROW(compare_segmentation(points, options), ConfigError);
  options = spacing_of(0.1);
  options.tolerance_factors = {0.0};
  EXPECT_THROW(compare_segmentation(points, options), ConfigError);
}

/// A grid of n x m points with the given segment in the plane through (5e5, 5e6, 100) with a slope.
std::vector<LabelledPoint> slab(int n, int m, std::uint32_t segment) {
  std::vector<LabelledPoint> points;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) points.push_back({{5e5 + 0.6 * i, 5e6 + j, 100.0 + 0.8 * i}, segment, 1});
  }
  return points;
}

TEST(Compactness_OfRectangles, IsTheRatioOfTheirSides) {
  // The variance of n equidistant numbers is (n² - 1) / 12.
  EXPECT_NEAR(*mean_compactness(slab(8, 8, 1)), 1.0, 1e-6);
  const double ratio = std::sqrt((5.0 * 5 - 1) / (20.0 * 20 - 1));
  EXPECT_NEAR(*mean_compactness(slab(5, 20, 1)), ratio, 1e-9);
  auto both = slab(8, 8, 4);
  for (const LabelledPoint& p : slab(20, 5, 2)) both.push_back(p);
  EXPECT_NEAR(*mean_compactness(both), (64.0 + 100.0 * ratio) / 164.0, 1e-6);
  EXPECT_NEAR(*mean_compactness(slab(10, 1, 1)), 0.0, 1e-6);
}

TEST(Compactness_OfSegmentsWithoutShape, IsUndefined) {
  EXPECT_EQ(mean_compactness({}), std::nullopt);
  EXPECT_EQ(mean_compactness(slab(2, 1, 1)), std::nullopt);
  EXPECT_EQ(mean_compactness(slab(4, 4, 0)), std::nullopt);
  std::vector<LabelledPoint> same(5, {{1, 2, 3}, 1, 1});
  EXPECT_EQ(mean_compactness(same), std::nullopt);
}

TEST(SegmentationText_Json, Results_CanBeReadBack) {
  const SegmentationComparison c = compare_segmentation(corner(), spacing_of(0.1));
  const auto json = nlohmann::json::parse(to_json(c));
  EXPECT_EQ(json["schema"], 1);
  EXPECT_EQ(json["segments"], 4);
  EXPECT_EQ(json["achievable_accuracy"], 1.0);
  EXPECT_EQ(json["variation_of_information"], 1.0);
  ASSERT_EQ(json["boundaries"].size(), 3U);
  EXPECT_EQ(json["boundaries"][0]["recall"], 1.0);
  const auto nothing = nlohmann::json::parse(to_json(compare_segmentation({}, spacing_of(1.0))));
  EXPECT_TRUE(nothing["achievable_accuracy"].is_null());
  EXPECT_TRUE(nothing["unsegmented_share"].is_null());
  EXPECT_TRUE(nothing["boundaries"][0]["recall"].is_null());
}

TEST(SegmentationText_Csv, EveryLine_HasAsManyCellsAsNames) {
  for (const auto& points : {corner(), std::vector<LabelledPoint>{}}) {
    std::istringstream text(to_csv(compare_segmentation(points, spacing_of(0.1))));
    std::string line;
    std::getline(text, line);
    const auto commas = std::count(line.begin(), line.end(), ',');
    EXPECT_TRUE(line.starts_with("tolerance,tolerance_spacings,boundary_recall,"));
    int rows = 0;
    for (; std::getline(text, line); ++rows) EXPECT_EQ(std::count(line.begin(), line.end(), ','), commas);
    EXPECT_EQ(rows, 3);
  }
}

TEST(SegmentationText_Table, SaysWhatItCounts) {
  const std::string text = to_table(compare_segmentation(corner(), spacing_of(0.1)));
  EXPECT_NE(text.find("4 of 100 points on average, on 2 surfaces"), std::string::npos) << text;
  EXPECT_NE(text.find("achievable accuracy"), std::string::npos);
  EXPECT_EQ(text.back(), '\n');
  EXPECT_NE(to_table(compare_segmentation({}, spacing_of(0.1))).find(" - "), std::string::npos);
}

}  // namespace
}  // namespace arris::evaluate
