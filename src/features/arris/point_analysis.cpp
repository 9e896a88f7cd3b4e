#include "features/arris/point_analysis.h"

#include <algorithm>
#include <cmath>

#include "features/arris/judgement.h"

namespace arris {
namespace {

/// No fold has an rms about one plane above 1.2 in the first ball, 1.5 with noise of 0.8: this is a volume or layers.
constexpr double kVolumeRms = 1.6;
/// Fold fits below this rms, spacings, need no larger ball.
constexpr double kQuietRms = 0.1;
/// Fold fits above this rms on the second ball need the third.
constexpr double kNoisyRms = 0.45;
constexpr double kFairRms = 0.3;
constexpr double kFarLine = 3.0;
/// The third ball is looked at if two planes explain the second this much better than one.
constexpr double kPromisingShare = 0.75;
/// The fit on a larger ball is believed if its rms is at most this multiple of the smaller one's, plus a bit.
constexpr double kRmsGrowth = 1.4;
constexpr double kRmsAllowance = 0.03;
/// Noise does not grow with the ball, folds do: by 9 / 5.
constexpr double kNoiseGrowth = 1.3;
/// Two planes explain noise hardly better than one: their rms stays above this share.
constexpr double kNoiseShare = 0.65;
/// Second and third ball: flat below this rms.
constexpr double kFlatRmsOf[] = {kFlatRms, 0.3, 0.5};

/// Noise that two-plane fits show is partly bad fit; boundaries are judged with at most this much.
constexpr double kUnknownNoise = 0.3;
constexpr double kMostRimNoise = 0.3;

struct LevelFit : FoldFit {
  int level = 0;
  bool flat = false;
  bool arms = false;
  bool layers = false;
};

LevelFit fit_level(const BallPoints& points, int level) {
  LevelFit fit;
  fit.level = level;
  const double radius = kBallRadii[level];
  fit.radius = radius;
  fit.all_count = static_cast<double>(points.count);
  if (fit.all_count < kLeastBallMembers || fit.all_count > kMostBallPoints) return fit;
  const FittedPlane all = fit_plane(sum_within(points, radius));
  fit.all_rms = all.rms;
  fit.flat = all.rms < kFlatRmsOf[level];
  if (fit.flat) return fit;
  const PlanePair pair = fit_plane_pair(points, radius, all);
  fit.layers = pair.kind == PlanePair::Kind::kLayers;
  if (pair.kind == PlanePair::Kind::kArms) fit.arms = refine_fold(points, pair, fit.line);
  return fit;
}

bool believable(const LevelFit& larger, const LevelFit& smaller) {
  return larger.flat ||
         (larger.arms && (!smaller.arms || larger.line.rms < kRmsGrowth * smaller.line.rms + kRmsAllowance));
}

}  // namespace

bool analyse_point(const PointProspects& prospects, BallProvider& balls, AnalysisScratch& scratch, bool want_fold,
                   bool want_boundary, PointContour& contour) {
  contour = {};
  const BallPoints* first = balls.ball(0);
  if (first == nullptr) return false;
  if (static_cast<double>(first->count) > kMostBallPoints) return true;
  double noise = prospects.rms < kVolumeRms ? prospects.rms : kUnknownNoise;
  if (prospects.fold && prospects.rms < kVolumeRms && want_fold) {
    LevelFit best;
    if (prospects.scatter) {
      if (prospects.off_centre < kCentredShare) return true;
      best.flat = true;
      best.all_rms = prospects.rms;
    }
    const bool scatter = best.flat;
    if (!scatter) best = fit_level(*first, 0);
    const double first_rms = best.arms ? best.line.rms : 1.0;
    bool noisy_plane = false;
    // A fair fit whose line is far away, or two sheets, will not become a fold at the point in a larger ball.
    const bool settled = best.layers || (first_rms < kFairRms && best.line.distance > kFarLine);
    if (first_rms > kQuietRms && !settled && !scatter) {
      const BallPoints* second = balls.ball(1);
      if (second == nullptr) return false;
      if (first_rms > kNoiseShare * best.all_rms) {
        const FittedPlane all = fit_plane(sum_within(*second, kBallRadii[1]));
        noisy_plane = all.rms < std::min(kNoiseGrowth * prospects.rms, kMostNoise);
        if (noisy_plane) noise = all.rms;
      }
      if (!noisy_plane) {
        const LevelFit wide = fit_level(*second, 1);
        const double second_rms = wide.arms ? wide.line.rms : 1.0;
        if (believable(wide, best)) best = wide;
        const bool worth_it = wide.arms && second_rms < kPromisingShare * wide.all_rms;
        if (first_rms > kNoisyRms && second_rms > kNoisyRms && worth_it) {
          const BallPoints* third = balls.ball(2);
          if (third == nullptr) return false;
          const LevelFit widest = fit_level(*third, 2);
          if (believable(widest, best)) best = widest;
        }
      }
    }
    if (!noisy_plane) {
      noise = best.flat ? best.all_rms : best.arms ? std::min(best.line.rms, kMostRimNoise) : kUnknownNoise;
      if (best.arms && !best.flat && judge_fold(best, *balls.ball(best.level), contour)) return true;
    }
  }
  if (want_boundary) {
    RimShape rim = look_for_gap(*first, kBallRadii[0], noise, scratch.rim);
    if (rim.width < kLeastRimWidth &&
        rim.gap_deg >= kLeastGap_deg) {  // A scan line; its neighbours may be in the next ball.
      const BallPoints* second = balls.ball(1);
      if (second == nullptr) return false;
      rim = look_for_gap(*second, kBallRadii[1], noise, scratch.rim);
    }
    if (!may_be_rim(rim)) return true;
    measure_beside_gap(scratch.rim, rim);
    judge_rim(rim, noise, contour);
  }
  return true;
}

}  // namespace arris
