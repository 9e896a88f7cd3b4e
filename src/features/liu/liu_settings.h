#pragma once
/// @file LiuParameters turned into lattice steps, ready for the inner loops.

#include <cstdint>

#include "core/lattice.h"
#include "features/liu/entropy_scale.h"
#include "features/liu/fold_test.h"
#include "features/liu/liu_parameters.h"
#include "features/neighbourhood/azimuth_gap.h"
#include "features/neighbourhood/local_spacing.h"
#include "features/neighbourhood/neighbour_search.h"

namespace arris {

/// Switches that must not change any result; tests use them to show that.
struct LiuSwitches {
  bool early_rejection = true;
  Arithmetic narrowest = Arithmetic::kFloat;
};

struct LiuSettings {
  /// Throws ConfigError if a parameter is out of range or R_max exceeds 2^30 lattice steps.
  LiuSettings(const LiuParameters& parameters, const Lattice& lattice, const LiuSwitches& switches);

  LiuParameters parameters;
  LiuSwitches switches;
  double step;           ///< Data units per lattice step.
  double max_reach;      ///< R_max, steps.
  std::uint64_t max_d2;  ///< floor(R_max²).
  ScaleRange scale;
  AzimuthGapTest gap_test;

  SearchLimits limits() const {
    return {static_cast<std::size_t>(parameters.k_max), max_reach, max_d2, switches.narrowest};
  }
  /// Spacings to use at a point: the estimate, or the one the user gave.
  LocalSpacing spacing(const Neighbours& neighbours) const;
  double far_distance(const LocalSpacing& spacing) const;             ///< d_thr, steps.
  FoldThresholds fold_thresholds(const LocalSpacing& spacing) const;  ///< r (at most R_max) and C'_f1, steps.
};

}  // namespace arris
