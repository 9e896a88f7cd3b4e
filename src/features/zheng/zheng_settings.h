#pragma once
/// @file ZhengParameters turned into lattice steps, and how far anything may reach.

#include <cstdint>

#include "core/lattice.h"
#include "features/supervoxel/supervoxel_table.h"
#include "features/zheng/zheng_method.h"

namespace arris {

/// Lengths that hold for one supervoxel or for two that touch; steps.
struct ZhengLengths {
  double spacing = 0.0;
  double cap = 0.0;    ///< Contacts are no longer than this.
  double alpha = 0.0;  ///< Radius of the alpha shape.
  double seam = 0.0;   ///< T of section 2.3.
};

/// No supervoxel counts as sampled more sparsely than this many times `spacing`: that bounds the halo.
constexpr double kMostLocalSpacing = 2.0;
/// Radius of the ball that a fold is fitted to and a border judged in, in local spacings (improved only) ...
constexpr double kJudgedBall = 5.0;
/// ... and of the one that is asked where there is noise; but no ball is larger than so many times `spacing`.
constexpr double kWideBall = 9.0;
constexpr double kLargestJudgedBall = kJudgedBall * kMostLocalSpacing;

struct ZhengSettings {
  /// Throws ConfigError if a parameter is out of range or the reach exceeds 2^26 steps.
  ZhengSettings(const ZhengParameters& parameters, const Lattice& lattice);

  ZhengParameters parameters;
  double step;           ///< Data units per lattice step.
  ZhengLengths typical;  ///< Where the spacing is `spacing`.

  /// Lengths at a supervoxel: literally the typical ones; improved, those that follow a factor grow with the
  /// supervoxel's own spacing, between the typical and kMostLocalSpacing times that.
  ZhengLengths lengths(const SupervoxelTable& table, std::uint32_t label) const;
};

/// zheng_halo.
double zheng_reach(const ZhengParameters& parameters);

}  // namespace arris
