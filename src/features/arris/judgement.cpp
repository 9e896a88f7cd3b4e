#include "features/arris/judgement.h"

#include <algorithm>
#include <cmath>

#include "features/arris/curved_surface.h"
#include "features/arris/edge_score.h"
#include "features/numerics/exact_math.h"

namespace arris {
namespace {

constexpr double kLeastTurn_deg = 28.0;
constexpr double kMostRmsShare = 0.6;
constexpr double kLeastArmShare = 1.0 / 8.0;
constexpr double kMostDistance = 0.94;
/// A fold must explain the points better than a smooth surface does.
constexpr double kMostCurvedShare = 0.93;

constexpr double kCertainGap_deg = 135.0;
constexpr double kMostDepth = 0.7;
/// A disc this large without points beside the point: by chance less than once in 10^6 points.
constexpr double kLeastEmptyRadius = 2.2;
/// A hole that the disc of 5 spacings reaches across: an empty disc of this radius, and surface on its other side (scan
/// lines far apart have empty discs on both sides).
constexpr double kLeastHoleRadius = 2.2;
constexpr double kLeastOpposite = 4.0;
constexpr double kHoleDepth = 0.5;
/// Clouds are full of such discs: the layer must be thin.
constexpr double kLeastHoleInnerShare = 0.9;
constexpr double kMostHoleRms = 0.25;
constexpr double kFalseAlarms = 1e-4;
constexpr double kLeastAzimuths = 8.0;
constexpr double kLeastInnerShare = 0.7;
/// A layer stands out from what is around it.
constexpr double kMostBeyondShare = 0.5;

/// The a-contrario gap of n directions: wider ones come about by chance less than kFalseAlarms times.
double significant_gap_deg(double n) {
  // (1 - gap / 360)^(n - 1) * n = kFalseAlarms.
  const double exponent = log_of_positive(kFalseAlarms / n) / (n - 1.0);
  // 1 - exp(x) for x in about [-2, 0): the series of exp needs no library.
  double term = 1.0;
  double sum = 1.0;
  for (int i = 1; i <= 24; ++i) {
    term *= exponent / i;
    sum += term;
  }
  return 360.0 * (1.0 - sum);
}

bool has_wide_gap(const RimShape& rim) {
  return rim.gap_deg >= kLeastGap_deg && rim.gap_deg >= significant_gap_deg(rim.count);
}

bool is_thin(const RimShape& rim) {
  return rim.inner_share >= kLeastHoleInnerShare && rim.rms <= kMostHoleRms;
}

}  // namespace

bool judge_fold(const FoldFit& fit, const BallPoints& points, PointContour& contour) {
  const FoldLine& line = fit.line;
  const double arms = line.count_a + line.count_b;
  contour.line_spacing = std::min(1.0, fit.radius * std::sqrt(kPi / arms));
  if (line.angle_deg > 180.0 - kLeastTurn_deg) return false;
  if (line.rms > kMostRmsShare * fit.all_rms) return false;
  if (std::min(line.count_a, line.count_b) < kLeastArmShare * fit.all_count) return false;
  if (line.distance > kMostDistance * contour.line_spacing) return false;
  if (line.support_a < 1 || line.support_b < 1) return false;
  const double curved_rms = curved_surface_rms(points, line);
  if (line.rms > kMostCurvedShare * curved_rms) return false;
  contour.kind = PointContour::Kind::kFold;
  contour.line = line;
  contour.nearest = line.foot;
  contour.direction = line.direction;
  FoldEvidence evidence;
  evidence.ball_radius = fit.radius;
  evidence.line_spacing = contour.line_spacing;
  evidence.distance = line.distance;
  evidence.position_error = line.position_error;
  evidence.angle_deg = line.angle_deg;
  evidence.rms = line.rms;
  evidence.all_rms = fit.all_rms;
  evidence.curved_rms = curved_rms;
  evidence.count_a = line.count_a;
  evidence.count_b = line.count_b;
  evidence.all_count = fit.all_count;
  evidence.support_a = line.support_a;
  evidence.support_b = line.support_b;
  contour.score = fold_score(evidence);
  return true;
}

bool may_be_rim(const RimShape& rim) {
  if (rim.gap_deg <= 0.0) return false;
  if (rim.count < kLeastAzimuths || rim.inner_share < kLeastInnerShare || rim.offset > rim.gate) return false;
  if (rim.width < kLeastRimWidth || rim.beyond_share > kMostBeyondShare) return false;
  return has_wide_gap(rim) || is_thin(rim);
}

bool judge_rim(const RimShape& rim, double noise, PointContour& contour) {
  if (!may_be_rim(rim)) return false;
  const bool open = has_wide_gap(rim) && (rim.depth <= kMostDepth || rim.gap_deg >= kCertainGap_deg ||
                                          rim.empty_radius >= kLeastEmptyRadius);
  const bool small_hole = is_thin(rim) && rim.empty_radius >= kLeastHoleRadius && rim.opposite >= kLeastOpposite;
  if (!open && !small_hole) return false;
  contour.kind = PointContour::Kind::kBoundary;
  contour.gap_deg = rim.gap_deg;
  contour.nearest = rim.nearest;
  contour.direction = rim.direction;
  RimEvidence evidence;
  evidence.gap_deg = small_hole ? std::max(rim.gap_deg, kCertainGap_deg) : rim.gap_deg;  // The disc stands for both:
  evidence.depth = small_hole ? std::min(rim.depth, kHoleDepth) : rim.depth;             // the ball reaches across.
  evidence.empty_radius = rim.empty_radius;
  evidence.count = rim.count;
  evidence.inner_share = rim.inner_share;
  evidence.offset = rim.offset;
  evidence.gate = rim.gate;
  evidence.rms = rim.rms;
  evidence.width = rim.width;
  evidence.noise = noise;
  contour.score = rim_score(evidence);
  return true;
}

}  // namespace arris
