#include "features/arris/edge_score.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "features/numerics/exact_math.h"

namespace arris {
namespace {

// Limits of the candidates.
constexpr double kMostAngle_deg = 160.0;
constexpr double kMostRmsShare = 0.85;
constexpr double kLeastArmShare = 1.0 / 12.0;
constexpr double kMostDistance = 1.4;
constexpr double kMostCurvedShare = 1.02;
constexpr double kLeastAzimuths = 6.0;
constexpr double kLeastInnerShare = 0.6;
constexpr double kLeastWidth = 0.5;

// Weights as fit_score.py prints them, in the order of the features below.
constexpr double kFoldWeights[] = {
    3.156,     // constant
    0.54451,   // margin
    0.55732,   // margin below 0
    -0.31093,  // margin above 2
    -5.4861,   // position_error
    -0.41464,  // rms_share
    0.7933,    // curved_share
    -3.5055,   // curved_share above 0.8
    6.2697,    // turn
    0.71126,   // line_spacing
    -1.7755,   // log count
    1.9065,    // second ball or third
    0.55719,   // third ball
};

constexpr double kRimWeights[] = {
    -36.099,    // constant
    4.2308,     // gap
    -11.968,    // gap above 180 deg
    -7.4051,    // gap * noise
    0.56335,    // depth
    -8.3733,    // depth above 0.3
    5.6607,     // depth above 0.7
    4.3901,     // depth * noise
    -0.11686,   // log empty_radius
    0.0091548,  // log empty_radius above 0.8
    2.366,      // depth above 0.3 * log empty_radius above 0.8
    8.3021,     // log count
    -9.8659,    // log count above 3.8
    6.6126,     // inner_share
    -8.0699,    // inner_share above 0.85
    0.39851,    // rms
    -3.0139,    // rms above 0.3
    4.0216,     // noise
    -3.9488,    // offset above 0.3 gates
};

double above(double x, double start) {
  return std::max(x - start, 0.0);
}

/// 1 / (1 + exp(-x)) from + - * / only; x is cut at +-30, so that the result is neither 0 nor 1.
double logistic(double x) {
  constexpr double kMost = 30.0;
  constexpr int kHalvings = 6;  // Brings the argument to at most 0.47, where twelve terms reach 1e-14.
  constexpr int kTerms = 12;
  const double reduced = -std::min(std::fabs(x), kMost) / (1 << kHalvings);
  double power = 1.0;
  for (int i = kTerms; i >= 1; --i) power = 1.0 + power * reduced / i;
  for (int i = 0; i < kHalvings; ++i) power *= power;
  return x >= 0.0 ? 1.0 / (1.0 + power) : power / (1.0 + power);
}

template <std::size_t N>
double probability(const double (&weights)[N], const double (&features)[N]) {
  double sum = 0.0;
  for (std::size_t i = 0; i < N; ++i) sum += weights[i] * features[i];
  return logistic(sum);
}

}  // namespace

bool is_fold_candidate(const FoldEvidence& f) {
  return f.angle_deg <= kMostAngle_deg && f.rms <= kMostRmsShare * f.all_rms &&
         std::min(f.count_a, f.count_b) >= kLeastArmShare * f.all_count &&
         f.distance <= kMostDistance * f.line_spacing && f.support_a + f.support_b >= 1.0 &&
         f.rms <= kMostCurvedShare * f.curved_rms;
}

bool is_rim_candidate(const RimEvidence& r) {
  return r.gap_deg >= kLeastRimGap_deg && r.count >= kLeastAzimuths && r.inner_share >= kLeastInnerShare &&
         r.offset <= r.gate && r.width >= kLeastWidth;
}

double fold_score(const FoldEvidence& f) {
  const double distance = std::min(f.distance / f.line_spacing, 2.0);
  // How many standard deviations the line is within a spacing; no line is known to better than a tenth.
  const double error2 = f.position_error * f.position_error + 0.01;
  const double margin = std::clamp((1.0 - distance) / std::sqrt(error2), -4.0, 6.0);
  const double curved = f.curved_rms > 0.0 ? std::min(f.rms / f.curved_rms, 1.0) : 1.0;
  const double features[std::size(kFoldWeights)] = {1.0,
                                                    margin,
                                                    std::min(margin, 0.0),
                                                    above(margin, 2.0),
                                                    std::min(f.position_error, 1.5),
                                                    f.rms / f.all_rms,
                                                    curved,
                                                    above(curved, 0.8),
                                                    std::min(180.0 - f.angle_deg, 60.0) / 60.0,
                                                    f.line_spacing,
                                                    log_of_positive(f.all_count),
                                                    f.ball_radius > 5.0 ? 1.0 : 0.0,
                                                    f.ball_radius > 9.0 ? 1.0 : 0.0};
  return probability(kFoldWeights, features);
}

double rim_score(const RimEvidence& r) {
  const double gap = std::min(r.gap_deg, 220.0) / 180.0;
  const double depth = std::min(r.depth, 1.5);
  const double noise = std::min(r.noise, 1.0);
  const double rms = std::min(r.rms, 1.0);
  const double count = log_of_positive(r.count);
  // Beside holes and other concave rims the hull reaches over the void: what is deep in it may still be at the rim.
  const double empty = log_of_positive(std::clamp(r.empty_radius, 0.8, 8.0));
  const double features[std::size(kRimWeights)] = {1.0,
                                                   gap,
                                                   above(gap, 1.0),
                                                   gap * noise,
                                                   depth,
                                                   above(depth, 0.3),
                                                   above(depth, 0.7),
                                                   depth * noise,
                                                   empty,
                                                   above(empty, 0.8),
                                                   above(depth, 0.3) * above(empty, 0.8),
                                                   count,
                                                   above(count, 3.8),
                                                   r.inner_share,
                                                   above(r.inner_share, 0.85),
                                                   rms,
                                                   above(rms, 0.3),
                                                   noise,
                                                   above(r.offset / r.gate, 0.3)};
  return probability(kRimWeights, features);
}

}  // namespace arris
