/// @file Takes the place of features/arris/point_analysis.cpp in bench_score_samples: the same analysis, but every fold
/// and every rim that the loose limits let pass is kept as a sample, whatever its score. Change both together.

#include <algorithm>
#include <cmath>

#include "candidate.h"
#include "features/arris/curved_surface.h"
#include "features/arris/point_analysis.h"
#include "features/numerics/exact_math.h"

namespace arris::bench {

std::vector<Candidate>& met_candidates() {
  static std::vector<Candidate> candidates;
  return candidates;
}

}  // namespace arris::bench

namespace arris {
namespace {

constexpr double kQuietRms = 0.1;
constexpr double kNoisyRms = 0.45;
constexpr double kRmsGrowth = 1.4;
constexpr double kRmsAllowance = 0.03;
constexpr double kNoiseGrowth = 1.3;
constexpr double kNoiseShare = 0.65;
constexpr double kFlatRmsOf[] = {kFlatRms, 0.3, 0.5};
constexpr double kLeastRimWidth = 0.7;
constexpr double kMostRimNoise = 0.5;

struct LevelFit {
  int level = 0;
  bool flat = false;
  bool arms = false;
  double all_rms = 0.0;
  double all_count = 0.0;
  FoldLine line;
};

LevelFit fit_level(const BallPoints& points, int level) {
  LevelFit fit;
  fit.level = level;
  const double radius = kBallRadii[level];
  fit.all_count = static_cast<double>(points.count);
  if (fit.all_count < kLeastBallMembers || fit.all_count > kMostBallPoints) return fit;
  const FittedPlane all = fit_plane(sum_within(points, radius));
  fit.all_rms = all.rms;
  fit.flat = all.rms < kFlatRmsOf[level];
  if (fit.flat) return fit;
  const PlanePair pair = fit_plane_pair(points, radius, all);
  if (pair.kind == PlanePair::Kind::kArms) fit.arms = refine_fold(points, pair, fit.line);
  return fit;
}

bool believable(const LevelFit& larger, const LevelFit& smaller) {
  return larger.flat ||
         (larger.arms && (!smaller.arms || larger.line.rms < kRmsGrowth * smaller.line.rms + kRmsAllowance));
}

/// The fold of the ball that decides, as in features/arris/point_analysis.cpp.
struct FoldSearch {
  LevelFit best;
  double noise = 0.0;
  bool noisy_plane = false;
};

bool search_fold(const BallPoints& first, double first_noise, BallProvider& balls, FoldSearch& search) {
  LevelFit& best = search.best;
  best = fit_level(first, 0);
  const double first_rms = best.arms ? best.line.rms : 1.0;
  if (first_rms > kQuietRms) {
    const BallPoints* second = balls.ball(1);
    if (second == nullptr) return false;
    if (first_rms > kNoiseShare * best.all_rms) {
      const FittedPlane all = fit_plane(sum_within(*second, kBallRadii[1]));
      search.noisy_plane = all.rms < std::min(kNoiseGrowth * first_noise, kMostNoise);
      if (search.noisy_plane) search.noise = all.rms;
    }
    if (!search.noisy_plane) {
      const LevelFit wide = fit_level(*second, 1);
      const double second_rms = wide.arms ? wide.line.rms : 1.0;
      if (believable(wide, best)) best = wide;
      if (first_rms > kNoisyRms && second_rms > kNoisyRms && !wide.flat) {
        const BallPoints* third = balls.ball(2);
        if (third == nullptr) return false;
        const LevelFit widest = fit_level(*third, 2);
        if (believable(widest, best)) best = widest;
      }
    }
  }
  if (!search.noisy_plane) {
    search.noise = best.flat ? best.all_rms : best.arms ? std::min(best.line.rms, kMostRimNoise) : 0.3;
  }
  return true;
}

FoldEvidence evidence_of(const LevelFit& fit, const BallPoints& points) {
  FoldEvidence e;
  const FoldLine& line = fit.line;
  e.ball_radius = kBallRadii[fit.level];
  e.line_spacing = std::min(1.0, e.ball_radius * std::sqrt(kPi / (line.count_a + line.count_b)));
  e.distance = line.distance;
  e.position_error = line.position_error;
  e.angle_deg = line.angle_deg;
  e.rms = line.rms;
  e.all_rms = fit.all_rms;
  e.count_a = line.count_a;
  e.count_b = line.count_b;
  e.all_count = fit.all_count;
  e.support_a = line.support_a;
  e.support_b = line.support_b;
  e.curved_rms = curved_surface_rms(points, line);
  return e;
}

RimEvidence evidence_of(const RimShape& rim, double noise) {
  RimEvidence e;
  e.gap_deg = rim.gap_deg;
  e.depth = rim.depth;
  e.empty_radius = rim.empty_radius;
  e.count = rim.count;
  e.inner_share = rim.inner_share;
  e.offset = rim.offset;
  e.gate = rim.gate;
  e.rms = rim.rms;
  e.width = rim.width;
  e.noise = noise;
  return e;
}

}  // namespace

bool analyse_point(const PointProspects& prospects, BallProvider& balls, AnalysisScratch& scratch, bool want_fold,
                   bool want_boundary, PointContour& contour) {
  contour = {};
  const BallPoints* first = balls.ball(0);
  if (first == nullptr) return false;
  if (static_cast<double>(first->count) > kMostBallPoints) return true;
  bench::Candidate candidate;
  double noise = prospects.rms;
  if (prospects.fold && want_fold) {
    FoldSearch search;
    if (!search_fold(*first, prospects.rms, balls, search)) return false;
    noise = search.noise;
    const LevelFit& best = search.best;
    if (!search.noisy_plane && best.arms && !best.flat) {
      candidate.fold = evidence_of(best, *balls.ball(best.level));
      candidate.has_fold = is_fold_candidate(candidate.fold);
    }
  }
  if (want_boundary) {
    RimShape rim = measure_rim(*first, kBallRadii[0], noise, scratch.rim);
    if (rim.width < kLeastRimWidth && rim.gap_deg >= kLeastRimGap_deg) {
      const BallPoints* second = balls.ball(1);
      if (second == nullptr) return false;
      rim = measure_rim(*second, kBallRadii[1], noise, scratch.rim);
    }
    candidate.rim = evidence_of(rim, noise);
    candidate.has_rim = is_rim_candidate(candidate.rim);
  }
  if (!candidate.has_fold && !candidate.has_rim) return true;
  // The record's score carries the number of the sample, so that it can be joined with the point.
  contour.kind = candidate.has_fold ? PointContour::Kind::kFold : PointContour::Kind::kBoundary;
  bench::met_candidates().push_back(candidate);
  contour.score = static_cast<double>(bench::met_candidates().size());
  return true;
}

}  // namespace arris
