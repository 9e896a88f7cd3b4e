#pragma once
/// @file EdgeScore of arris's own method: the probability that an edge of the truth passes within one spacing of a point.

#include <array>

namespace arris {

/// What is known of a fold at a point. Lengths in the point's own spacing estimate.
struct FoldEvidence {
  double ball_radius = 5.0;     ///< Of the ball whose points speak for the fold.
  double line_spacing = 1.0;    ///< Spacing along the arms, (0, 1].
  double distance = 0.0;        ///< Of the point to the line, >= 0.
  double position_error = 0.0;  ///< Standard deviation of the line's place, >= 0.
  double angle_deg = 180.0;     ///< Between the arms, (0, 180].
  double rms = 0.0;             ///< Of the arms' points about their surfaces.
  double all_rms = 0.0;         ///< Of the ball's points about one plane.
  double curved_rms = 0.0;      ///< Of the ball's points about a smooth surface; may be infinite.
  double count_a = 0.0, count_b = 0.0, all_count = 0.0;  ///< Points of the arms and of the ball.
  double support_a = 0.0, support_b = 0.0;  ///< Points of either arm next to the point's place on the line.
};

/// What is known of the rim of the surface at a point: RimShape and the noise that it was measured with.
struct RimEvidence {
  double ball_radius = 5.0;
  double gap_deg = 0.0, depth = 0.0, empty_radius = 0.0, count = 0.0, inner_share = 0.0, offset = 0.0, gate = 1.0;
  double rms = 0.0, width = 0.0, noise = 0.0;
};

/// Below this azimuth gap a point is no candidate for a boundary.
constexpr double kLeastRimGap_deg = 95.0;

/// Hard limits: what is beyond them is not worth a score.
bool is_fold_candidate(const FoldEvidence& fold);
bool is_rim_candidate(const RimEvidence& rim);

double fold_score(const FoldEvidence& fold);
double rim_score(const RimEvidence& rim);

}  // namespace arris
