#include "evaluate/contour_evaluation.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "evaluate/label_comparison.h"
#include "random_edges.h"

namespace arris::evaluate {
namespace {

constexpr double kSpacing = 0.5;

Truth line_truth(double length = 10.0, const Vec3& from = {0, 0, 0}) {
  Truth truth;
  truth.properties["spacing"] = exact_text(kSpacing);
  truth.edges = {make_segment(EdgeKind::kConvex, "ridge", from, from + Vec3{length, 0, 0}, 90.0)};
  return truth;
}

/// Points every `step` on the x axis from step / 2, moved by `offset` along y.
std::vector<PredictedPoint> line_points(double length, double step, double offset = 0.0) {
  std::vector<PredictedPoint> points;
  for (double x = 0.5 * step; x < length; x += step) points.push_back({x, offset, 0, 0xff, 1.0F});
  return points;
}

const ToleranceResult& at(const ContourEvaluation& evaluation, double tolerance) {
  for (const ToleranceResult& row : evaluation.tolerances) {
    if (std::abs(row.tolerance - tolerance) < 1e-12) return row;
  }
  throw std::logic_error("no such tolerance");
}

TEST(Evaluation_PointsOnTheEdge, OnePerSpacing_IsPerfectEverywhere) {
  EvaluationOptions options;
  options.scores = true;
  const ContourEvaluation result = evaluate_contours(line_points(10.0, kSpacing), line_truth(), options);
  ASSERT_EQ(result.tolerances.size(), 4U);
  for (const ToleranceResult& row : result.tolerances) {
    EXPECT_DOUBLE_EQ(*row.precision, 1.0);
    EXPECT_DOUBLE_EQ(*row.recall, 1.0);
    EXPECT_DOUBLE_EQ(*row.f1, 1.0);
    EXPECT_DOUBLE_EQ(*row.average_precision, 1.0);
    EXPECT_DOUBLE_EQ(*row.thinness, 1.0);
    EXPECT_DOUBLE_EQ(*row.offset_rms, 0.0);
    EXPECT_EQ(row.gaps, 0U);
  }
  EXPECT_DOUBLE_EQ(*result.mean_to_truth, 0.0);
  EXPECT_DOUBLE_EQ(*result.mean_to_detections, kSpacing / 4);
  EXPECT_DOUBLE_EQ(*result.hausdorff, kSpacing / 4);
}

TEST(Evaluation_ShiftedPoints, KnownShift_IsTheOffset) {
  constexpr double kShift = 0.3;
  const ContourEvaluation result = evaluate_contours(line_points(10.0, 0.125, kShift), line_truth(), {});
  const ToleranceResult& narrow = at(result, 0.5 * kSpacing);
  EXPECT_DOUBLE_EQ(*narrow.precision, 0.0);
  EXPECT_DOUBLE_EQ(*narrow.recall, 0.0);
  EXPECT_DOUBLE_EQ(*narrow.f1, 0.0);
  EXPECT_FALSE(narrow.offset_mean);
  const ToleranceResult& wide = at(result, kSpacing);
  EXPECT_DOUBLE_EQ(*wide.f1, 1.0);
  EXPECT_NEAR(*wide.offset_mean, kShift, 1e-12);
  EXPECT_DOUBLE_EQ(*wide.offset_median, kShift);
  EXPECT_NEAR(*wide.offset_rms, kShift, 1e-12);
  EXPECT_DOUBLE_EQ(*wide.thinness, 4.0);
  EXPECT_NEAR(*result.mean_to_truth, kShift, 1e-12);
}

TEST(Evaluation_HalfCovered, FirstHalf_HasRecallOneHalfAndOneGap) {
  EvaluationOptions options;
  options.tolerance_factors = {0.5};
  const ContourEvaluation result = evaluate_contours(line_points(50.0, kSpacing), line_truth(100.0), options);
  const ToleranceResult& row = at(result, 0.5 * kSpacing);
  EXPECT_NEAR(*row.recall, 0.5, kSpacing / 100.0);
  EXPECT_DOUBLE_EQ(*row.precision, 1.0);
  EXPECT_EQ(row.gaps, 1U);
  EXPECT_NEAR(row.longest_gap, 50.0, kSpacing);
  EXPECT_DOUBLE_EQ(*row.gaps_per_length, 0.01);
  EXPECT_NEAR(*result.hausdorff, 50.0, kSpacing);
  EXPECT_NEAR(*result.hausdorff_95, 45.0, kSpacing);
}

TEST(Evaluation_DenseDetections, TenTimesAsMany_AreNotPunished) {
  const ContourEvaluation result = evaluate_contours(line_points(10.0, kSpacing / 10), line_truth(), {});
  EXPECT_DOUBLE_EQ(*at(result, kSpacing).f1, 1.0);
  EXPECT_DOUBLE_EQ(*at(result, kSpacing).thinness, 10.0);
}

TEST(Evaluation_FarPoints, ThreeInThirteen_CostPrecisionOnly) {
  auto points = line_points(10.0, 1.0);
  for (int i = 0; i < 3; ++i) points.push_back({double(i), 100.0, 0, 0xff, 0.5F});
  const ContourEvaluation result = evaluate_contours(points, line_truth(), {});
  EXPECT_DOUBLE_EQ(*at(result, 2 * kSpacing).precision, 10.0 / 13.0);
  EXPECT_EQ(at(result, 2 * kSpacing).false_positives, 3U);
  EXPECT_DOUBLE_EQ(*at(result, 2 * kSpacing).recall, 1.0);
}

TEST(Evaluation_NonFinitePoints, AreCountedAndDropped) {
  auto points = line_points(10.0, kSpacing);
  points.push_back({0, std::numeric_limits<double>::quiet_NaN(), 0, 0xff, 1.0F});
  points.push_back({std::numeric_limits<double>::infinity(), 0, 0, 0xff, 1.0F});
  const ContourEvaluation result = evaluate_contours(points, line_truth(), {});
  EXPECT_EQ(result.non_finite, 2U);
  EXPECT_EQ(result.detections, 20U);
  EXPECT_DOUBLE_EQ(*at(result, kSpacing).f1, 1.0);
}

TEST(Evaluation_ToleranceExactlyReached, AtLargeCoordinates_IsWithin) {
  // Half a spacing away, as the points of a regular grid are, where doubles are 1e-9 apart.
  const Vec3 far{5e5, 5e6, 100};
  std::vector<PredictedPoint> points;
  for (int i = 0; i < 200; ++i) points.push_back({far.x + 0.05 * i, far.y + 0.1, far.z, 0xff, 1.0F});
  Truth truth = line_truth(10.0, far);
  truth.properties["spacing"] = "0.2";
  EXPECT_DOUBLE_EQ(*evaluate_contours(points, truth, {}).tolerances.front().precision, 1.0);
}

TEST(Evaluation_Noise, AddsToleranceOfThreeSigma) {
  Truth truth = line_truth();
  truth.properties["noise"] = "0.4";
  EXPECT_EQ(evaluate_contours({}, truth, {}).tolerances.size(), 5U);
  EXPECT_NO_THROW(at(evaluate_contours({}, truth, {}), 3 * 0.4));
  EvaluationOptions quiet;
  quiet.noise = 0.0;
  EXPECT_EQ(evaluate_contours({}, truth, quiet).tolerances.size(), 4U);
}

TEST(Evaluation_NothingDetected, RecallIsZeroAndPrecisionUndefined) {
  const ContourEvaluation result = evaluate_contours({}, line_truth(), {});
  const ToleranceResult& row = at(result, kSpacing);
  EXPECT_FALSE(row.precision);
  EXPECT_DOUBLE_EQ(*row.recall, 0.0);
  EXPECT_DOUBLE_EQ(*row.f1, 0.0);
  EXPECT_EQ(row.gaps, 1U);
  EXPECT_FALSE(result.hausdorff);
}

TEST(Evaluation_NoTruth, EveryDetectionIsFalse) {
  Truth truth;
  truth.properties["spacing"] = "0.5";
  const ContourEvaluation result = evaluate_contours(line_points(10.0, 1.0), truth, {});
  const ToleranceResult& row = at(result, kSpacing);
  EXPECT_DOUBLE_EQ(*row.precision, 0.0);
  EXPECT_EQ(row.false_positives, 10U);
  EXPECT_FALSE(row.recall);
  EXPECT_FALSE(row.f1);
}

TEST(Evaluation_Kinds, EdgesThatDoNotCount_AreFalseUnlessForgiven) {
  Truth truth = line_truth();
  truth.edges.push_back(make_segment(EdgeKind::kBoundary, "eave", {0, 20, 0}, {10, 20, 0}));
  auto points = line_points(10.0, kSpacing);
  const auto others = line_points(10.0, kSpacing, 20.0);
  points.insert(points.end(), others.begin(), others.end());

  const ToleranceResult all = at(evaluate_contours(points, truth, {}), kSpacing);
  EXPECT_DOUBLE_EQ(*all.f1, 1.0);
  EXPECT_DOUBLE_EQ(*all.recall_of_kind[static_cast<std::size_t>(EdgeKind::kBoundary)], 1.0);
  EXPECT_FALSE(all.recall_of_kind[static_cast<std::size_t>(EdgeKind::kConcave)]);

  EvaluationOptions folds;
  folds.kinds = kFoldKinds;
  EXPECT_DOUBLE_EQ(*at(evaluate_contours(points, truth, folds), kSpacing).precision, 0.5);
  folds.forgive_other_kinds = true;
  const ToleranceResult forgiven = at(evaluate_contours(points, truth, folds), kSpacing);
  EXPECT_DOUBLE_EQ(*forgiven.precision, 1.0);
  EXPECT_EQ(forgiven.forgiven, 20U);
}

TEST(Evaluation_ClassMask, OtherClasses_AreNoDetections) {
  auto points = line_points(10.0, kSpacing);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].classes = i % 2 == 0 ? 1 : 4;
  EvaluationOptions options;
  options.class_mask = 4;
  const ContourEvaluation result = evaluate_contours(points, line_truth(), options);
  EXPECT_EQ(result.detections, 10U);
  EXPECT_EQ(result.masked, 10U);
}

TEST(Evaluation_Circle, GapOverTheSeam_IsOneGap) {
  Truth truth;
  truth.properties["spacing"] = "0.1";
  truth.edges = {make_circle(EdgeKind::kRimConvex, "rim", {0, 0, 0}, {0, 0, 1}, 5.0, 90.0)};
  std::vector<PredictedPoint> points;
  for (int i = 250; i < 750; ++i) {
    const Vec3 p = truth.edges[0].point_at(i / 1000.0);
    points.push_back({p.x, p.y, p.z, 0xff, 1.0F});
  }
  const ToleranceResult row = at(evaluate_contours(points, truth, {}), 0.1);
  EXPECT_EQ(row.gaps, 1U);
  EXPECT_NEAR(row.longest_gap, 5.0 * std::numbers::pi, 0.3);
  EXPECT_NEAR(*row.recall, 0.5, 0.01);
}

TEST(Evaluation_AveragePrecision, GoodBeforeBad_IsBetterThanBadBeforeGood) {
  auto points = line_points(10.0, kSpacing);
  const auto bad = line_points(10.0, kSpacing, 50.0);
  points.insert(points.end(), bad.begin(), bad.end());
  EvaluationOptions options;
  options.scores = true;
  const auto area = [&](float good_score, float bad_score) {
    for (std::size_t i = 0; i < 20; ++i) {
      points[i].score = good_score;
      points[i + 20].score = bad_score;
    }
    return *at(evaluate_contours(points, line_truth(), options), kSpacing).average_precision;
  };
  EXPECT_DOUBLE_EQ(area(0.9F, 0.1F), 1.0);
  EXPECT_DOUBLE_EQ(area(0.1F, 0.9F), 0.5);
  EXPECT_DOUBLE_EQ(area(0.5F, 0.5F), 0.5);
}

TEST(Evaluation_AveragePrecision, TwoSteps_AreSummedByHand) {
  // First half of the edge at full precision, second half found together with as many false points: 1/2 * 1 + 1/2 *
  // 20/30.
  auto points = line_points(10.0, kSpacing);
  for (std::size_t i = 10; i < 20; ++i) points[i].score = 0.5F;
  for (int i = 0; i < 10; ++i) points.push_back({double(i), 50, 0, 0xff, 0.5F});
  EvaluationOptions options;
  options.scores = true;
  options.tolerance_factors = {0.5};
  const double area = *at(evaluate_contours(points, line_truth(), options), 0.5 * kSpacing).average_precision;
  EXPECT_NEAR(area, 0.5 + 0.5 * 20.0 / 30.0, 1e-3);
}

TEST(Evaluation_Ceiling, InputThatShowsAThird_LimitsRecall) {
  const Truth truth = line_truth(30.0);
  const EvaluationOptions options;
  InputCoverage coverage(truth, options);
  for (int i = 0; i < 1000; ++i) {
    const std::vector<Vec3> block{{i * 0.01, 0.01, 0}, {i * 0.01, 30, 0}, {std::nan(""), 0, 0}};
    coverage.add(block);
  }
  const ContourEvaluation result = evaluate_contours({}, truth, options, &coverage);
  EXPECT_NEAR(*at(result, 0.5 * kSpacing).ceiling, 10.25 / 30.0, 0.25 / 30.0);
  EXPECT_NEAR(*at(result, 3 * kSpacing).ceiling, 11.5 / 30.0, 0.25 / 30.0);
}

TEST(Evaluation_Options, InvalidOnes_AreRefused) {
  EXPECT_THROW(evaluate_contours({}, Truth{}, {}), ConfigError);
  EvaluationOptions options;
  options.tolerance_factors = {0.0};
  EXPECT_THROW(evaluate_contours({}, line_truth(), options), ConfigError);
  options = {};
  options.spacing = -1.0;
  EXPECT_THROW(evaluate_contours({}, line_truth(), options), ConfigError);
  options.spacing = 1e-300;
  EXPECT_THROW(evaluate_contours({}, line_truth(), options), ConfigError);
  const InputCoverage coverage(line_truth(), {});
  options.spacing = 0.1;
  EXPECT_THROW(evaluate_contours({}, line_truth(), options, &coverage), ConfigError);
}

RC_GTEST_PROP(Evaluation_Oracle, AnyPointsAndEdges_EqualBruteForce, ()) {
  Truth truth;
  truth.edges = *rc::gen::container<std::vector<TruthEdge>>(any_edge());
  const auto positions = *rc::gen::container<std::vector<Vec3>>(position());
  EvaluationOptions options;
  options.spacing = 1.0;
  std::vector<PredictedPoint> points;
  for (const Vec3& p : positions) points.push_back({p.x, p.y, p.z, 0xff, 1.0F});
  const ContourEvaluation result = evaluate_contours(points, truth, options);
  for (const ToleranceResult& row : result.tolerances) {
    const double limit = row.tolerance * (1.0 + 1e-6);
    std::uint64_t hits = 0;
    for (const Vec3& p : positions) {
      bool near = false;
      for (const TruthEdge& edge : truth.edges) near = near || edge.distance(p) <= limit;
      hits += near ? 1 : 0;
    }
    RC_ASSERT(row.true_positives == hits);
    RC_ASSERT(row.true_positives + row.false_positives == positions.size());
    double covered = 0.0, total = 0.0;
    for (const TruthEdge& edge : truth.edges) {
      const int pieces = static_cast<int>(std::ceil(edge.length() / 0.5));
      for (int i = 0; i < pieces; ++i) {
        const Vec3 sample = edge.point_at((i + 0.5) / pieces);
        bool near = false;
        for (const Vec3& p : positions) near = near || norm(p - sample) <= limit;
        total += edge.length() / pieces;
        if (near) covered += edge.length() / pieces;
      }
    }
    RC_ASSERT(row.recall.has_value() == (total > 0.0));
    if (total > 0.0) RC_ASSERT(std::abs(*row.recall - covered / total) < 1e-9);
  }
}

/// Two parallel edges 100 m apart with spacings of 0.1 and 1 m, and coarse ones twice as large.
Truth two_spacings() {
  Truth truth = line_truth();
  truth.edges.push_back(make_segment(EdgeKind::kBoundary, "eave", {0, 100, 0}, {10, 100, 0}));
  truth.edges[0].spacing = 0.1;
  truth.edges[1].spacing = 1.0;
  for (TruthEdge& edge : truth.edges) edge.spacing_max = 2.0 * edge.spacing;
  return truth;
}

TEST(Evaluation_LocalSpacing, SameOffset_IsFarFromAFineEdgeAndNearACoarseOne) {
  std::vector<PredictedPoint> points = line_points(10.0, 0.05, 0.15);
  for (const PredictedPoint& p : line_points(10.0, 0.05, 100.15)) points.push_back(p);
  EvaluationOptions options;
  options.spacing_of = SpacingOf::kLocal;
  const ContourEvaluation result = evaluate_contours(points, two_spacings(), options);
  ASSERT_EQ(result.tolerances.size(), 4U);  // No tolerance of the noise.
  const ToleranceResult& one = at(result, 1.0);
  EXPECT_DOUBLE_EQ(*one.precision, 0.5);
  EXPECT_DOUBLE_EQ(*one.recall, 0.5);
  EXPECT_DOUBLE_EQ(*one.recall_of_kind[static_cast<std::size_t>(EdgeKind::kBoundary)], 1.0);
  EXPECT_DOUBLE_EQ(*one.recall_of_kind[static_cast<std::size_t>(EdgeKind::kConvex)], 0.0);
  EXPECT_NEAR(*one.offset_mean, 0.15, 1e-9);  // In spacings of 1 m.
  EXPECT_NEAR(*one.thinness, 20.0, 1e-9);
  EXPECT_DOUBLE_EQ(*at(result, 2.0).f1, 1.0);
  EXPECT_NEAR(*result.hausdorff, std::hypot(0.15, 0.025), 1e-9);  // In data units.
  options.spacing_of = SpacingOf::kLocalMax;
  EXPECT_DOUBLE_EQ(*at(evaluate_contours(points, two_spacings(), options), 1.0).f1, 1.0);
}

TEST(Evaluation_LocalSpacing, NearestEdgeInMetres_NeedNotBeTheOneThatCounts) {
  Truth truth = two_spacings();
  truth.edges[1] = make_segment(EdgeKind::kBoundary, "eave", {0, 1, 0}, {10, 1, 0});
  truth.edges[1].spacing = 1.0;
  EvaluationOptions options;
  options.spacing_of = SpacingOf::kLocal;
  // 0.4 m from the fine edge (4 spacings), 0.6 m from the coarse one.
  const ContourEvaluation result = evaluate_contours(line_points(10.0, 0.1, 0.4), truth, options);
  EXPECT_DOUBLE_EQ(*at(result, 1.0).precision, 1.0);
  EXPECT_DOUBLE_EQ(*at(result, 0.5).precision, 0.0);
}

TEST(Evaluation_LocalSpacing, CoverageOfTheInput_IsInLocalSpacings) {
  EvaluationOptions options;
  options.spacing_of = SpacingOf::kLocal;
  InputCoverage coverage(two_spacings(), options);
  std::vector<Vec3> input;
  for (const double y : {0.15, 100.15}) {
    for (double x = 0.025; x < 10.0; x += 0.05) input.push_back({x, y, 0});
  }
  coverage.add(input);
  const ContourEvaluation result = evaluate_contours({}, two_spacings(), options, &coverage);
  EXPECT_DOUBLE_EQ(*at(result, 1.0).ceiling, 0.5);
  EXPECT_DOUBLE_EQ(*at(result, 2.0).ceiling, 1.0);
}

TEST(Evaluation_LocalSpacing, TruthWithoutIt_IsRefused) {
  EvaluationOptions options;
  options.spacing_of = SpacingOf::kLocal;
  EXPECT_THROW(evaluate_contours({}, line_truth(), options), ConfigError);
}

TEST(Evaluation_MinScore, PointsBelowIt_AreNoDetections) {
  std::vector<PredictedPoint> points = line_points(10.0, kSpacing);
  for (PredictedPoint p : line_points(10.0, kSpacing, 5.0)) {
    p.score = 0.4F;
    points.push_back(p);
  }
  EvaluationOptions options;
  options.scores = true;
  options.min_score = 0.5F;
  const ContourEvaluation result = evaluate_contours(points, line_truth(), options);
  EXPECT_EQ(result.below_min_score, 20U);
  EXPECT_DOUBLE_EQ(*at(result, kSpacing).precision, 1.0);
}

Truth square_truth() {
  Truth truth;
  truth.properties["spacing"] = exact_text(kSpacing);
  const std::vector<Vec3> corners{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    // In two pieces: where a straight line is cut is no corner.
    const Vec3 middle = 0.5 * (corners[i] + corners[(i + 1) % 4]);
    truth.edges.push_back(make_segment(EdgeKind::kConvex, "", corners[i], middle, 90.0));
    truth.edges.push_back(make_segment(EdgeKind::kConvex, "", middle, corners[(i + 1) % 4], 90.0));
  }
  return truth;
}

TEST(Evaluation_Corners, OfASquare_AreFourAndTheirRecallIsTheirOwn) {
  std::vector<PredictedPoint> points;  // All along the sides but for the last 2 m before each corner.
  for (double t = 2.0; t <= 8.0; t += 0.1) {
    for (const double side : {0.0, 10.0}) {
      points.push_back({t, side, 0, 0xff, 1.0F});
      points.push_back({side, t, 0, 0xff, 1.0F});
    }
  }
  const ContourEvaluation result = evaluate_contours(points, square_truth(), {});
  EXPECT_NEAR(result.corner_length, 4 * 2 * 2 * kSpacing, 1e-9);
  EXPECT_DOUBLE_EQ(*at(result, kSpacing).recall_of_corners, 0.0);
  EXPECT_GT(*at(result, kSpacing).recall, 0.6);
  for (const double place : {0.0, 10.0}) points.push_back({place, place, 0, 0xff, 1.0F});
  EXPECT_NEAR(*at(evaluate_contours(points, square_truth(), {}), 1.0).recall_of_corners, 0.5, 0.26);
}

TEST(Evaluation_Corners, StraightLineAndCircle_HaveNone) {
  EXPECT_EQ(evaluate_contours({}, line_truth(), {}).corner_length, 0.0);
  Truth circle = line_truth();
  circle.edges = {make_circle(EdgeKind::kRimConvex, "", {0, 0, 0}, {0, 0, 1}, 5.0, 90.0)};
  EXPECT_EQ(evaluate_contours({}, circle, {}).corner_length, 0.0);
}

TEST(LabelComparison_Counts, KnownTable_GivesIouAndMcc) {
  // Input: 8 points on the edge, 12 far from it. Called: 6 of the former, 3 of the latter.
  std::vector<Vec3> input;
  for (int i = 0; i < 8; ++i) input.push_back({1.0 + i, 0, 0});
  for (int i = 0; i < 12; ++i) input.push_back({0.5 * i, 5, 0});
  std::vector<PredictedPoint> called;
  for (const int i : {0, 1, 2, 3, 4, 5, 8, 9, 10}) {
    const Vec3& p = input[static_cast<std::size_t>(i)];
    called.push_back({p.x, p.y, p.z, 0xff, 1.0F});
  }
  LabelComparison labels(called, line_truth(), {});
  labels.add(std::span(input).first(5));
  labels.add(std::span(input).subspan(5));
  const LabelAgreement result = labels.result();
  EXPECT_EQ(result.tolerance_spacings, 0.5);
  EXPECT_EQ(result.true_positives, 6U);
  EXPECT_EQ(result.false_positives, 3U);
  EXPECT_EQ(result.false_negatives, 2U);
  EXPECT_EQ(result.true_negatives, 9U);
  EXPECT_DOUBLE_EQ(*result.iou, 6.0 / 11.0);
  EXPECT_NEAR(*result.mcc, (6.0 * 9 - 3 * 2) / std::sqrt(9.0 * 8 * 12 * 11), 1e-12);
}

TEST(LabelComparison_Tolerance, IsHalfASpacingAndAWholeOneWithNoise) {
  const std::vector<Vec3> input{{5, 0.2, 0}, {5, 0.4, 0}, {5, 0.6, 0}};
  EvaluationOptions options;
  for (const double noise : {0.0, 0.1}) {
    options.noise = noise;
    LabelComparison labels({}, line_truth(), options);
    labels.add(input);
    EXPECT_EQ(labels.result().false_negatives, noise > 0.0 ? 2U : 1U);
    EXPECT_FALSE(labels.result().mcc);
  }
}

}  // namespace
}  // namespace arris::evaluate
