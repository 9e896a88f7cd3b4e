#include "features/seam_judge.h"

#include <algorithm>

#include "features/judgement.h"

namespace arris {
namespace {

/// A fold this near, spacings, ends the layer of the point: that is no border.
constexpr double kExplains = 2.0;
/// What two planes leave is noise up to here; more is a bad fit.
constexpr double kMostRimNoise = 0.3;

}  // namespace

PointContour judge_seam(const BallPoints& points, double radius, const SeamQuestion& question, RimScratch& scratch) {
  PointContour contour;
  const auto count = static_cast<double>(points.count);
  if (count < kLeastBallMembers || count > kMostBallPoints) return contour;
  double noise = std::min(question.rms, kMostRimNoise);
  if (question.rms >= kFlatRms) {
    FoldFit fit;
    fit.radius = radius;
    fit.all_count = count;
    const FittedPlane all = fit_plane(sum_within(points, radius));
    fit.all_rms = all.rms;
    const PlanePair pair = fit_plane_pair(points, radius, all);
    if (pair.kind == PlanePair::Kind::kArms && refine_fold(points, pair, fit.line)) {
      noise = std::min(fit.line.rms, kMostRimNoise);
      if (question.fold && fit.line.angle_deg <= 180.0 - question.least_turn_deg && judge_fold(fit, points, contour)) {
        return contour;
      }
      contour = {};
      const bool explained = fit.line.distance <= kExplains && fit.line.support_a > 0 && fit.line.support_b > 0;
      if (explained) return contour;
    }
  }
  if (question.border) {
    const RimShape rim = measure_rim(points, radius, noise, scratch);
    if (!judge_rim(rim, noise, contour)) contour = {};
  }
  return contour;
}

}  // namespace arris
