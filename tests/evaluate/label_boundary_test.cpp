#include "evaluate/label_boundary.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "evaluate/boundary_recall.h"
#include "random_labels.h"

namespace arris::evaluate {
namespace {

using Indices = std::vector<std::uint32_t>;

/// Points at x = 0, 1, 2, ... with the given faces.
std::vector<LabelledPoint> row(const std::vector<std::uint32_t>& faces) {
  std::vector<LabelledPoint> points;
  for (std::size_t i = 0; i < faces.size(); ++i) points.push_back({{static_cast<double>(i), 5e6, 0}, 0, faces[i]});
  return points;
}

TEST(LabelBoundary_OfARow, IsTheTwoSidesOfAChange) {
  const auto points = row({1, 1, 1, 1, 2, 2, 2, 2});
  EXPECT_EQ(find_label_boundary(points, &LabelledPoint::face, 0.99), Indices{});
  EXPECT_EQ(find_label_boundary(points, &LabelledPoint::face, 1.0), (Indices{3, 4}));
  EXPECT_EQ(find_label_boundary(points, &LabelledPoint::face, 2.5), (Indices{2, 3, 4, 5}));
  EXPECT_EQ(find_label_boundary(points, &LabelledPoint::segment, 2.5), Indices{});
}

TEST(LabelBoundary_StrayPoints, NeitherAreNorMakeBoundaryPoints) {
  auto points = row({1, 1, 0, 1, 1});
  points.push_back({{std::numeric_limits<double>::quiet_NaN(), 0, 0}, 0, 7});
  EXPECT_EQ(find_label_boundary(points, &LabelledPoint::face, 1.5), Indices{});
  points[1].segment = 9;  // Beside it, 0 is a label like the others.
  EXPECT_EQ(find_label_boundary(points, &LabelledPoint::segment, 1.5), (Indices{0, 1}));
}

TEST(LabelBoundary_NoPoints, GiveNone) {
  EXPECT_EQ(find_label_boundary({}, &LabelledPoint::face, 1.0), Indices{});
}

TEST(LabelBoundary_Radius, ThatCannotBe_IsRefused) {
  const auto points = row({1, 2});
  EXPECT_THROW(find_label_boundary(points, &LabelledPoint::face, 0.0), ConfigError);
  EXPECT_THROW(find_label_boundary(points, &LabelledPoint::face, std::nan("")), ConfigError);
  EXPECT_THROW(find_label_boundary(points, &LabelledPoint::face, 1e-7), ConfigError);
}

RC_GTEST_PROP(LabelBoundary_OfRandomClouds, EqualsThatOfAllPairs, ()) {
  const auto points = *any_labelled_cloud();
  const double radius = *rc::gen::element(0.25, 0.5, 0.6, 1.0, 3.0);
  for (const auto label : {&LabelledPoint::face, &LabelledPoint::segment}) {
    Indices expected;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const bool boundary = is_judged(points[i]) && std::any_of(points.begin(), points.end(), [&](const auto& other) {
                              return is_judged(other) && other.*label != points[i].*label &&
                                     norm(other.position - points[i].position) <= radius + 1e-9;
                            });
      if (boundary) expected.push_back(i);
    }
    RC_ASSERT(find_label_boundary(points, label, radius) == expected);
  }
}

TEST(BoundaryRecall_OfAShiftedBoundary, RisesAtTheShift) {
  auto points = row({1, 1, 1, 1, 1, 2, 2, 2, 2, 2});                                  // Boundary points 4 and 5.
  for (std::size_t i = 0; i < points.size(); ++i) points[i].segment = i < 7 ? 1 : 2;  // 6 and 7.
  const auto truth = find_label_boundary(points, &LabelledPoint::face, 1.0);
  const auto segments = find_label_boundary(points, &LabelledPoint::segment, 1.0);
  const std::vector<double> tolerances{0.5, 1.0, 2.0};
  const auto result = compare_boundaries(points, truth, segments, tolerances);
  ASSERT_EQ(result.size(), 3U);
  EXPECT_EQ(result[0].recall, 0.0);
  EXPECT_EQ(result[1].recall, 0.5);  // 5 is 1 from 6, 4 is 2 from it.
  EXPECT_EQ(result[2].recall, 1.0);
  EXPECT_EQ(result[1].precision, 0.5);
  EXPECT_EQ(result[2].tolerance, 2.0);
  const auto nothing = compare_boundaries(points, truth, {}, tolerances);
  EXPECT_EQ(nothing[2].recall, 0.0);
  EXPECT_EQ(nothing[2].precision, std::nullopt);
}

RC_GTEST_PROP(BoundaryRecall_OfRandomClouds, EqualsThatOfAllPairs, ()) {
  const auto points = *any_labelled_cloud();
  const auto truth = find_label_boundary(points, &LabelledPoint::face, 0.5);
  const auto segments = find_label_boundary(points, &LabelledPoint::segment, 0.5);
  const std::vector<double> tolerances{0.25, 0.5, 2.0};
  const auto result = compare_boundaries(points, truth, segments, tolerances);
  for (std::size_t k = 0; k < tolerances.size(); ++k) {
    const auto share = [&](const Indices& from, const Indices& to) -> std::optional<double> {
      if (from.empty()) return std::nullopt;
      const auto near = std::count_if(from.begin(), from.end(), [&](std::uint32_t i) {
        return std::any_of(to.begin(), to.end(), [&](std::uint32_t j) {
          return norm(points[i].position - points[j].position) <= tolerances[k] + 1e-9;
        });
      });
      return static_cast<double>(near) / static_cast<double>(from.size());
    };
    RC_ASSERT(result[k].recall == share(truth, segments));
    RC_ASSERT(result[k].precision == share(segments, truth));
  }
}

}  // namespace
}  // namespace arris::evaluate
