#pragma once
/// @file EdgeScore of arris's own method: how likely it is that an edge passes within one spacing of a point.
///
/// Logistic models of what the method measured at the point, fitted to scenes with exact truth by
/// bench/accuracy/score_samples (which says on which, and how well the scores hold on scenes that were kept aside).
/// Right means: an edge of any kind within one spacing; in scans, whose lines are farther apart than the points in
/// them, within two of the local spacings sqrt(area per point).
///
/// Laws: (1) results are in (0, 1) and are never NaN; (2) they depend on the evidence only, with the same bits on every
/// machine; (3) more `distance` never raises a fold's score. Pure functions of constant time.

#include <limits>

namespace arris {

/// What is known of a fold at a point. Lengths in the point's own estimate of the spacing.
struct FoldEvidence {
  double ball_radius = 5.0;     ///< Of the ball whose points speak for the fold: kBallRadii.
  double line_spacing = 1.0;    ///< Spacing along the arms, (0, 1].
  double distance = 0.0;        ///< Of the point to the line, >= 0.
  double position_error = 0.0;  ///< Standard deviation of the line's place, >= 0.
  double angle_deg = 180.0;     ///< Between the arms, (0, 180].
  double rms = 0.0;             ///< Of the arms' points about their surfaces.
  double all_rms = 1.0;         ///< Of the ball's points about one plane, > 0.
  /// Of the ball's points about a smooth surface; infinite: none fits, or not known yet.
  double curved_rms = std::numeric_limits<double>::infinity();
  double count_a = 0.0, count_b = 0.0;      ///< Points of either arm.
  double all_count = 1.0;                   ///< Points of the ball, >= 1.
  double support_a = 0.0, support_b = 0.0;  ///< Points of either arm beside the point's place on the line.
};

/// What is known of the rim of the surface that holds a point: RimShape (rim_shape.h), and what it was measured with.
struct RimEvidence {
  double gap_deg = 0.0;       ///< [0, 360].
  double depth = 0.0;         ///< >= 0.
  double empty_radius = 0.0;  ///< >= 0.
  double count = 1.0;         ///< >= 1.
  double inner_share = 0.0;   ///< [0, 1].
  double offset = 0.0;        ///< >= 0.
  double gate = 1.0;          ///< > 0.
  double rms = 0.0;           ///< >= 0.
  double width = 0.0;         ///< >= 0.
  double noise = 0.0;         ///< Standard deviation of the points about their surface, >= 0.
};

/// A smaller azimuth gap is no candidate for a boundary; measure_rim() does not look further either.
constexpr double kLeastRimGap_deg = 105.0;
/// A fold with at least this score needs no look at the rim; otherwise the likelier of both stands.
constexpr double kLikelyFoldScore = 0.5;

/// False for what the models were not fitted to and is never worth a score. A fold may be asked about before its
/// curved_rms is known.
bool is_fold_candidate(const FoldEvidence& fold);
bool is_rim_candidate(const RimEvidence& rim);

/// For candidates.
double fold_score(const FoldEvidence& fold);
double rim_score(const RimEvidence& rim);

}  // namespace arris
