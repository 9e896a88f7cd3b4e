#pragma once
/// @file Parameters of Liu et al.'s method (docs/methods-liu.md has the equations).

#include <cstdint>

namespace arris {

/// Lengths in data units, angles in degrees. 0 means "follows the local spacing" where said so.
struct LiuParameters {
  // Neighbourhood (eq. 1-6).
  int k_min = 20;                      ///< >= 3.
  int k_max = 30;                      ///< >= k_min, <= 200.
  int k_step = 2;                      ///< >= 1.
  bool covariance_with_target = true;  ///< S = {p} + neighbours; false: neighbours only (literal).
  double min_planarity = 0.05;  ///< A k with lambda2/lambda1 below this is rejected unless all are (scan-line guard).
  // Boundary (eq. 7-11).
  double gap_deg = 120.0;     ///< alpha_thr, (0, 360).
  double far_factor = 3.0;    ///< d_thr in mean distances to the 6 nearest neighbours; used if far_distance is 0.
  double far_distance = 0.0;  ///< d_thr; 0: far_factor times the local spacing.
  enum class Span : std::uint8_t {
    kBracket,
    kInner
  } span = Span::kBracket;  ///< Reading of the azimuth span in eq. 11.
  // Fold (eq. 12-24).
  double radius_factor = 6.0;   ///< Ball radius in local spacings; used if radius is 0.
  double radius = 0.0;          ///< Ball radius r; 0: follows the local spacing.
  double cf1_factor = 1.0;      ///< C'_f1 in local spacings; used if cf1 and fold_angle_deg are 0.
  double cf1 = 0.0;             ///< C'_f1; 0: follows the local spacing.
  double fold_angle_deg = 0.0;  ///< theta > 0: C'_f1 = max(0.2643 r cos(theta/2), 3 * 0.60 * noise).
  double noise = 0.0;           ///< sigma, for fold_angle_deg only.
  double cf2 = 4.0;             ///< C'_f2, >= 1.
  int top_m = 3;                ///< m, >= 1, <= 64.
  enum class Emit : std::uint8_t { kEmit, kSelf } emit = Emit::kEmit;  ///< Reading A (union of all balls' top m) or B.
  int min_votes = 1;  ///< Fold points with fewer votes are dropped at the merge.
  // Scale.
  double spacing = 0.0;     ///< > 0: one spacing for all points and all factors; 0: estimated per point.
  double max_radius = 0.0;  ///< R_max > 0: neighbours beyond it are not neighbours. Resolved before any tile is run.

  bool boundary = true;  ///< Run the boundary tests.
  bool fold = true;      ///< Run the fold tests.
};

/// Throws ConfigError, naming the option, if a value is outside its range (max_radius must be resolved, > 0).
void validate(const LiuParameters& parameters);

}  // namespace arris
