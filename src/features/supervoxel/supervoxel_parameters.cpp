#include "features/supervoxel/supervoxel_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/voxel.h"

namespace arris {
namespace {

/// Rings of voxels around a voxel on which its features depend: windows 2, their choice 2 more, point feature
/// histograms 2 more.
constexpr std::int32_t kFeatureRings = 6;
constexpr double kGrowthReach = 1.8;  // Of R_seed; SupervoxelClustering of PCL.
constexpr double kPi = 3.14159265358979323846;

void require(bool holds, const char* what) {
  if (!holds) throw ConfigError(what);
}

}  // namespace

void validate(const SupervoxelParameters& p) {
  require(std::isfinite(p.voxel) && p.voxel >= 0.0, "--voxel must be a positive length");
  require(std::isfinite(p.seed) && p.seed >= 0.0, "--seed must be a positive length");
  require(p.iterations >= 1 && p.iterations <= 100, "--iterations must be from 1 to 100");
  require(p.seed_support >= 0.0 && p.seed_support <= 1.0, "--seed-support must be from 0 to 1");
  for (const double weight : {p.lambda, p.mu, p.epsilon, p.normal_weight, p.spatial_weight, p.colour_weight}) {
    require(std::isfinite(weight) && weight >= 0.0, "weights of supervoxel features must be finite and not negative");
  }
  require(std::isfinite(p.colour_scale) && p.colour_scale > 0.0, "--colour-scale must be positive");
}

std::int32_t SupervoxelScale::halo_voxels() const {
  const auto cell = static_cast<std::int32_t>((seed_steps + voxel_steps - 1) / voxel_steps);
  return levels + cell + 2 + kFeatureRings;
}

SupervoxelScale resolve_scale(SupervoxelParameters& p, double spacing, const Lattice& lattice) {
  validate(p);
  if (p.voxel == 0.0) p.voxel = std::clamp(kVoxelSpacings * spacing, lattice.step, kMostVoxelSide * lattice.step);
  if (p.seed == 0.0) p.seed = kSeedVoxels * p.voxel;
  const double voxel_steps = std::round(p.voxel / lattice.step);
  if (!(voxel_steps >= 1.0 && voxel_steps <= kMostVoxelSide)) {
    throw ConfigError(fmt::format("--voxel {:g} is {:g} steps of the lattice ({:g}), outside of 1 to {}", p.voxel,
                                  p.voxel / lattice.step, lattice.step, kMostVoxelSide));
  }
  const double seed_steps = std::round(p.seed / lattice.step);
  if (!(seed_steps >= 2.0 * voxel_steps)) {
    throw ConfigError(fmt::format("--seed {:g} must be at least twice --voxel {:g}", p.seed, p.voxel));
  }
  if (!(seed_steps <= std::min(static_cast<double>(kMostSeedSteps), 1000.0 * voxel_steps))) {
    throw ConfigError(fmt::format("--seed {:g} is too large: at most 1000 times --voxel, and {} steps of the lattice",
                                  p.seed, kMostSeedSteps));
  }
  return make_scale(static_cast<std::int32_t>(voxel_steps), static_cast<std::int64_t>(seed_steps), p);
}

SupervoxelScale make_scale(std::int32_t voxel_steps, std::int64_t seed_steps, const SupervoxelParameters& parameters) {
  SupervoxelScale scale;
  scale.voxel_steps = voxel_steps;
  scale.seed_steps = seed_steps;
  scale.levels = static_cast<int>(kGrowthReach * static_cast<double>(seed_steps) / voxel_steps);
  scale.search_steps = seed_steps / 2;
  const double radius = static_cast<double>(scale.search_steps) / voxel_steps;
  scale.least_support = static_cast<std::uint32_t>(std::ceil(parameters.seed_support * kPi * radius * radius));
  return scale;
}

}  // namespace arris
