#include "evaluate/label_overlaps.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>

#include "random_labels.h"

namespace arris::evaluate {
namespace {

TEST(CountOverlaps_OfPoints, LeavesOutWhatHasNoLabel) {
  const std::vector<LabelledPoint> points{{{}, 3, 1}, {{}, 3, 2}, {{}, 1, 5}, {{}, 3, 1}, {{}, 0, 1}, {{}, 3, 0}};
  const std::vector<LabelOverlap> expected{{1, 5, 1}, {3, 1, 2}, {3, 2, 1}};
  EXPECT_EQ(count_overlaps(points), expected);
}

TEST(OverlapMeasures_OfAPerfectSegmentation, AreTheBest) {
  const std::vector<LabelOverlap> overlaps{{1, 8, 30}, {2, 7, 10}};
  const OverlapMeasures m = measure_overlaps(overlaps);
  EXPECT_EQ(m.points, 40U);
  EXPECT_EQ(m.segments, 2U);
  EXPECT_EQ(m.faces, 2U);
  EXPECT_EQ(m.undersegmentation, 0.0);
  EXPECT_EQ(m.corrected_undersegmentation, 0.0);
  EXPECT_EQ(m.achievable_accuracy, 1.0);
  EXPECT_EQ(m.adjusted_rand, 1.0);
  EXPECT_EQ(m.information_split, 0.0);
  EXPECT_EQ(m.information_joined, 0.0);
}

// Two faces of 100 points; segment 1 has 90 of the first and 4 of the second, segment 2 the other 10 and 96.
TEST(OverlapMeasures_OfALeak, AreThoseComputedByHand) {
  const std::vector<LabelOverlap> overlaps{{1, 1, 90}, {1, 2, 4}, {2, 1, 10}, {2, 2, 96}};
  const OverlapMeasures m = measure_overlaps(overlaps);
  // 4 of 94 is below 5 %: segment 1 counts for face 1 only; 10 of 106 is above.
  EXPECT_DOUBLE_EQ(*m.undersegmentation, (94.0 + 2.0 * 106.0) / 200.0 - 1.0);
  EXPECT_DOUBLE_EQ(*m.corrected_undersegmentation, 2.0 * (4.0 + 10.0) / 200.0);
  EXPECT_DOUBLE_EQ(*m.achievable_accuracy, 186.0 / 200.0);
  const auto pairs = [](double n) { return n * (n - 1) / 2; };
  const double both = pairs(90) + pairs(4) + pairs(10) + pairs(96), segments = pairs(94) + pairs(106);
  const double faces = 2 * pairs(100), chance = segments * faces / pairs(200);
  EXPECT_NEAR(*m.adjusted_rand, (both - chance) / (0.5 * (segments + faces) - chance), 1e-12);
  const auto plogp = [](double part, double whole) { return part / 200.0 * std::log2(whole / part); };
  EXPECT_NEAR(*m.information_joined, plogp(90, 94) + plogp(4, 94) + plogp(10, 106) + plogp(96, 106), 1e-12);
  EXPECT_NEAR(*m.information_split, plogp(90, 100) + plogp(4, 100) + plogp(10, 100) + plogp(96, 100), 1e-12);
}

TEST(OverlapMeasures_FivePercentRule, CountsMoreThanATwentieth) {
  EXPECT_EQ(measure_overlaps(std::vector<LabelOverlap>{{1, 1, 95}, {1, 2, 5}}).undersegmentation, 0.0);
  EXPECT_EQ(measure_overlaps(std::vector<LabelOverlap>{{1, 1, 94}, {1, 2, 6}}).undersegmentation, 1.0);
}

TEST(OverlapMeasures_OfHalves, CountBits) {
  // One face cut in four equal segments: two bits; two faces in one segment: one bit.
  const std::vector<LabelOverlap> split{{1, 1, 5}, {2, 1, 5}, {3, 1, 5}, {4, 1, 5}};
  EXPECT_EQ(measure_overlaps(split).information_split, 2.0);
  EXPECT_EQ(measure_overlaps(split).information_joined, 0.0);
  EXPECT_EQ(measure_overlaps(split).adjusted_rand, 0.0);
  const std::vector<LabelOverlap> joined{{1, 1, 7}, {1, 2, 7}};
  EXPECT_EQ(measure_overlaps(joined).information_joined, 1.0);
  EXPECT_EQ(measure_overlaps(joined).achievable_accuracy, 0.5);
  EXPECT_EQ(measure_overlaps(joined).corrected_undersegmentation, 1.0);
}

TEST(OverlapMeasures_OfNothing, AreUndefined) {
  const OverlapMeasures m = measure_overlaps({});
  EXPECT_EQ(m.segments, 0U);
  EXPECT_FALSE(m.undersegmentation || m.corrected_undersegmentation || m.achievable_accuracy || m.adjusted_rand ||
               m.information_split || m.information_joined);
  EXPECT_EQ(measure_overlaps(std::vector<LabelOverlap>{{1, 1, 1}}).adjusted_rand, 1.0);
}

/// Of pairs of points: in how many both labellings agree whether the two belong together, corrected for chance.
double adjusted_rand_by_pairs(const std::vector<LabelledPoint>& points) {
  double both = 0.0, segments = 0.0, faces = 0.0, all = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const bool segment = points[i].segment == points[j].segment, face = points[i].face == points[j].face;
      both += segment && face ? 1.0 : 0.0;
      segments += segment ? 1.0 : 0.0;
      faces += face ? 1.0 : 0.0;
      all += 1.0;
    }
  }
  const double chance = all > 0.0 ? segments * faces / all : 0.0, most = 0.5 * (segments + faces);
  return most > chance ? (both - chance) / (most - chance) : 1.0;
}

RC_GTEST_PROP(OverlapMeasures_OfRandomClouds, FollowTheirDefinitions, ()) {
  auto points = *any_labelled_cloud();
  std::erase_if(points, [](const LabelledPoint& p) { return p.face == 0 || p.segment == 0; });
  points.push_back({{}, 1, 1});
  const OverlapMeasures m = measure_overlaps(count_overlaps(points));
  const double n = static_cast<double>(points.size());
  std::map<std::uint32_t, std::map<std::uint32_t, double>> counts;  // By segment and face.
  for (const LabelledPoint& p : points) counts[p.segment][p.face] += 1.0;
  double grown = 0.0, misplaced = 0.0, best = 0.0;
  for (const auto& [segment, faces] : counts) {
    double size = 0.0, most = 0.0;
    for (const auto& [face, count] : faces) size += count;
    for (const auto& [face, count] : faces) {
      if (count > 0.05 * size) grown += size;
      misplaced += std::min(count, size - count);
      most = std::max(most, count);
    }
    best += most;
  }
  RC_ASSERT(std::abs(*m.undersegmentation - (grown / n - 1.0)) < 1e-12);
  RC_ASSERT(std::abs(*m.corrected_undersegmentation - misplaced / n) < 1e-12);
  RC_ASSERT(std::abs(*m.achievable_accuracy - best / n) < 1e-12);
  RC_ASSERT(std::abs(*m.adjusted_rand - adjusted_rand_by_pairs(points)) < 1e-9);
  // Numbers and order do not matter; exchanging the labellings exchanges split and joined.
  for (LabelledPoint& p : points) std::swap(p.segment, p.face);
  std::reverse(points.begin(), points.end());
  const OverlapMeasures exchanged = measure_overlaps(count_overlaps(points));
  RC_ASSERT(std::abs(*m.adjusted_rand - *exchanged.adjusted_rand) < 1e-12);
  RC_ASSERT(std::abs(*m.information_split - *exchanged.information_joined) < 1e-12);
}

}  // namespace
}  // namespace arris::evaluate
