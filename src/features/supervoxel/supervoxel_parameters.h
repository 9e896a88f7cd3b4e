#pragma once
/// @file Parameters of the supervoxel clustering (Zheng et al. 2018, section 2.1; Papon et al. 2013).

#include <cstdint>

#include "core/lattice.h"

namespace arris {

/// Lengths in data units. Weights are those of eq. (2) for kFpfh and of the three linear terms for kNormal.
struct SupervoxelParameters {
  enum class Features : std::uint8_t {
    kFpfh,    ///< D = sqrt(lambda Dc^2 / m^2 + mu Ds^2 / (3 R_seed^2) + epsilon D_HIK^2), eq. (2).
    kNormal,  ///< D = w_n (1 - |n . n'|) + w_s |dx| / R_seed + w_c |dRGB| / 255.
  } features = Features::kNormal;
  enum class Colour : std::uint8_t { kAuto, kOn, kOff } colour = Colour::kAuto;  ///< kAuto: if all inputs have it.

  double voxel = 0.0;  ///< R_voxel; 0: kVoxelSpacings times the spacing.
  double seed = 0.0;   ///< R_seed >= 2 R_voxel; 0: kSeedVoxels times R_voxel.
  int iterations = 3;  ///< 1 to 100.
  /// A seed is dropped if fewer than this share of the voxels of a full disc of radius R_seed / 2 can be reached from
  /// it inside that radius; [0, 1].
  double seed_support = 0.05;

  double lambda = 0.2;          ///< Weight of colour, >= 0.
  double mu = 0.4;              ///< Weight of space, >= 0.
  double epsilon = 1.0;         ///< Weight of the histograms, >= 0.
  double colour_scale = 100.0;  ///< m, in units of CIELab, > 0.
  double normal_weight = 1.0;   ///< kNormal, >= 0.
  double spatial_weight = 0.2;  ///< kNormal, >= 0.
  double colour_weight = 0.1;   ///< kNormal, >= 0.
};

constexpr double kVoxelSpacings = 1.5;
constexpr double kSeedVoxels = 8.0;  ///< The paper has 0.4 m / 0.03 m: 13.3.

/// Throws ConfigError, naming the option, if a value is out of range.
void validate(const SupervoxelParameters& parameters);

/// Lengths in whole lattice steps: what the clustering works with.
struct SupervoxelScale {
  std::int32_t voxel_steps = 1;
  std::int64_t seed_steps = 2;      ///< Side of a seed cell.
  int levels = 3;                   ///< Growth ends after so many voxels: int(1.8 R_seed / R_voxel), as in PCL.
  std::int64_t search_steps = 1;    ///< R_search = R_seed / 2.
  std::uint32_t least_support = 0;  ///< Voxels that must be reached within R_search, the seed's included.

  /// Voxels by which a tile must be covered around its core: growth, the seed cell of the leftovers, features.
  std::int32_t halo_voxels() const;
};

/// Most steps of a seed cell: squared distances stay exact in int64.
constexpr std::int64_t kMostSeedSteps = std::int64_t{1} << 26;

/// @param seed_steps  >= 2 voxel_steps.
SupervoxelScale make_scale(std::int32_t voxel_steps, std::int64_t seed_steps, const SupervoxelParameters& parameters);

/// Resolves what is 0. @param spacing  of the scan, data units; used where R_voxel is not given.
/// Throws ConfigError if a voxel is below one step, a seed cell too large, or R_seed < 2 R_voxel.
SupervoxelScale resolve_scale(SupervoxelParameters& parameters, double spacing, const Lattice& lattice);

}  // namespace arris
