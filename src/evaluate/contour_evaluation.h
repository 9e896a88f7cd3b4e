#pragma once
/// @file How well detected contour points agree with the truth.
///
/// Precision: share of detections within the tolerance of an edge; distances to edges are exact. Recall: share of the
/// truth's length, cut into pieces of half a spacing, whose midpoint has a detection within the tolerance. Never
/// one-to-one: dense and thin detections are judged alike, `thinness` tells them apart.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "evaluate/truth.h"

namespace arris::evaluate {

struct PredictedPoint {
  double x = 0.0, y = 0.0, z = 0.0;
  std::uint8_t classes = 0xff;  ///< EdgeClassBit flags; 0xff where the file has none.
  float score = 1.0F;           ///< EdgeScore.
};

/// What tolerances are multiples of: one spacing for the whole truth, or each edge's own `spacing` or `spacing_max`.
enum class SpacingOf : std::uint8_t { kWhole, kLocal, kLocalMax };

struct EvaluationOptions {
  double spacing = 0.0;  ///< s, > 0; 0: the truth's property "spacing".
  double noise = -1.0;   ///< sigma, >= 0; below 0: the truth's "noise", else 0.
  /// kLocal, kLocalMax: an edge whose own spacing is not known has that of the whole truth.
  SpacingOf spacing_of = SpacingOf::kWhole;
  /// In spacings, each > 0; with kWhole max(s, 3 sigma) is added.
  std::vector<double> tolerance_factors{0.5, 1.0, 2.0, 3.0};
  KindMask kinds = kEveryKind;  ///< Truth edges that count.
  /// Detections near truth edges of kinds that do not count are left out instead of being called false.
  bool forgive_other_kinds = false;
  std::uint8_t class_mask = 0xff;  ///< Predictions without any of these bits are no detections.
  /// Predictions with lower scores (or none, NaN) are no detections; ignored if `scores` is not set.
  float min_score = -std::numeric_limits<float>::infinity();
  bool scores = false;  ///< The predictions carry scores: average precision is computed.
};

/// Counts and shares at one tolerance. Shares are in [0, 1]; empty where their denominator is 0. Tolerance and offsets
/// are in data units, or with local spacing in spacings of the edge; all other lengths in data units.
struct ToleranceResult {
  double tolerance = 0.0;
  std::uint64_t true_positives = 0;
  std::uint64_t false_positives = 0;
  std::uint64_t forgiven = 0;  ///< Near other kinds only; in neither of the two.
  std::optional<double> precision;
  std::optional<double> recall;
  std::optional<double> f1;  ///< 0 if nothing was detected; empty only if there is no truth.
  std::array<std::optional<double>, kEdgeKinds> recall_of_kind;
  std::optional<double> recall_of_corners;  ///< Of the truth within 2 spacings of a corner.
  std::optional<double> ceiling;  ///< Recall that labelling every input point would have; needs InputCoverage.
  std::optional<double> average_precision;  ///< Area under the precision-recall curve as the score threshold falls.
  std::optional<double> offset_mean, offset_median, offset_rms;  ///< Distances of the true positives to the truth.
  std::optional<double> thinness;         ///< True positives per spacing of covered length; 1: a single row of points.
  std::uint64_t gaps = 0;                 ///< Uncovered runs along edges; a run does not turn corners.
  std::optional<double> gaps_per_length;  ///< gaps / total truth length.
  double longest_gap = 0.0;
};

/// The labels of all points of the input; see label_comparison.h.
struct LabelAgreement {
  double tolerance_spacings = 0.0;  ///< Points within so many spacings of the truth are contour points.
  std::uint64_t true_positives = 0, false_positives = 0, false_negatives = 0, true_negatives = 0;
  std::optional<double> iou;  ///< Of the contour points, [0, 1]; empty if there are none of either sort.
  std::optional<double> mcc;  ///< Matthews' correlation coefficient, [-1, 1]; empty if a row or column is empty.
};

struct ContourEvaluation {
  double spacing = 0.0;
  double noise = 0.0;
  std::uint64_t truth_edges = 0;
  double truth_length = 0.0;
  /// Of the part within 2 spacings of a corner: where ends of edges (of any kind, within 0.1 spacings of each other)
  /// leave in three or more directions, or turn by more than 30 degrees.
  double corner_length = 0.0;
  std::uint64_t detections = 0;
  SpacingOf spacing_of = SpacingOf::kWhole;
  std::uint64_t masked = 0;                 ///< Predictions dropped by class_mask.
  std::uint64_t below_min_score = 0;        ///< Predictions dropped by min_score.
  std::uint64_t non_finite = 0;             ///< Predictions dropped because a coordinate is NaN or infinite.
  std::vector<ToleranceResult> tolerances;  ///< Ascending.
  std::optional<LabelAgreement> labels;     ///< Filled in by the caller from LabelComparison.
  /// Over all detections and all truth, whatever the tolerance; empty without detections or truth.
  std::optional<double> mean_to_truth, mean_to_detections, chamfer;  ///< chamfer: mean of the two means.
  std::optional<double> hausdorff, hausdorff_95;  ///< Larger of the two directions; 95: of the 95 % quantiles.
};

/// How much of the truth the input cloud shows at all. Fed with the input in blocks; memory is bounded by the truth.
class InputCoverage {
 public:
  /// The options must be those of the evaluation that it is given to.
  InputCoverage(const Truth& truth, const EvaluationOptions& options);
  ~InputCoverage();
  InputCoverage(InputCoverage&&) noexcept;

  /// Non-finite points are skipped. Not thread-safe.
  void add(std::span<const Vec3> points);
  /// Distance from each truth sample to the nearest point added, infinite beyond the largest tolerance; in the units of
  /// the tolerances.
  std::vector<double> distances() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// O((n + m) log(n + m)) for n predictions and m truth samples; about 100 bytes per detection and 80 per sample. Runs
/// in parallel; the result does not depend on the number of threads. Throws ConfigError for invalid options, or if no
/// spacing is known.
ContourEvaluation evaluate_contours(std::span<const PredictedPoint> predictions, const Truth& truth,
                                    const EvaluationOptions& options, const InputCoverage* input = nullptr);

}  // namespace arris::evaluate
