#include "features/zheng/seam_judge.h"

#include <algorithm>

#include "features/arris/judgement.h"

namespace arris {
namespace {

/// A fold this near, spacings, ends the layer of the point: that is no border.
constexpr double kExplains = 2.0;
/// What two planes leave is noise up to here; more is a bad fit.
constexpr double kMostRimNoise = 0.3;
/// Folds whose fit leaves more, spacings, are looked at in the larger ball ...
constexpr double kNoisyRms = 0.22;
/// ... which is believed if it leaves at most this multiple, plus a bit.
constexpr double kRmsGrowth = 1.4;
constexpr double kRmsAllowance = 0.03;
/// A fair fit whose line is this far away, spacings, will not come to the point in a larger ball.
constexpr double kFairRms = 0.3;
constexpr double kFarLine = 3.0;

struct Fit : FoldFit {
  bool arms = false;
  const BallPoints* points = nullptr;
};

Fit fit_fold(const BallPoints& points, double radius) {
  Fit fit;
  fit.points = &points;
  fit.radius = radius;
  fit.all_count = static_cast<double>(points.count);
  if (fit.all_count > kMostBallPoints) return fit;
  const FittedPlane all = fit_plane(sum_within(points, radius));
  fit.all_rms = all.rms;
  const PlanePair pair = fit_plane_pair(points, radius, all);
  fit.arms = pair.kind == PlanePair::Kind::kArms && refine_fold(points, pair, fit.line);
  return fit;
}

Fit best_fit(const SeamQuestion& question, BallProvider& balls) {
  const Fit first = fit_fold(*balls.ball(0), question.radius[0]);
  const double left = first.arms ? first.line.rms : first.all_rms;
  const bool settled = first.arms && left < kFairRms && first.line.distance > kFarLine;
  if (left <= kNoisyRms || settled || question.radius[1] <= question.radius[0]) return first;
  const Fit wide = fit_fold(*balls.ball(1), question.radius[1]);
  const bool believable = wide.arms && wide.line.rms < kRmsGrowth * left + kRmsAllowance;
  return believable ? wide : first;
}

}  // namespace

PointContour judge_seam(const SeamQuestion& question, BallProvider& balls, RimScratch& scratch) {
  PointContour contour;
  double noise = std::min(question.rms, kMostRimNoise);
  if (question.rms >= kFlatRms) {
    const Fit fit = best_fit(question, balls);
    if (fit.arms) {
      noise = std::min(fit.line.rms, kMostRimNoise);
      const bool sharp = fit.line.angle_deg <= 180.0 - question.least_turn_deg;
      if (question.fold && sharp && judge_fold(fit, *fit.points, contour)) return contour;
      contour = {};
      if (fit.line.distance <= kExplains && fit.line.support_a > 0 && fit.line.support_b > 0) return contour;
    }
  }
  if (question.border) {
    const RimShape rim = measure_rim(*balls.ball(0), question.radius[0], noise, scratch);
    if (!judge_rim(rim, noise, contour)) contour = {};
  }
  return contour;
}

}  // namespace arris
