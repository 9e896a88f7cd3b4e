#pragma once
/// @file How well the labels of the input's points agree with the truth: every point of the scan is a contour point or
/// not.
///
/// A point should be one if it lies within half a spacing of an edge that counts, one spacing if there is noise. It is
/// called one if a detection has exactly its coordinates, so the detections must be points of the input.

#include <memory>

#include "evaluate/contour_evaluation.h"

namespace arris::evaluate {

/// Fed with the input in blocks; memory: 24 bytes per detection, and the truth.
class LabelComparison {
 public:
  /// The predictions and options of the evaluation. Throws ConfigError.
  LabelComparison(std::span<const PredictedPoint> predictions, const Truth& truth, const EvaluationOptions& options);
  ~LabelComparison();
  LabelComparison(LabelComparison&&) noexcept;

  /// Non-finite points are skipped. Runs in parallel; not thread-safe.
  void add(std::span<const Vec3> points);
  LabelAgreement result() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace arris::evaluate
