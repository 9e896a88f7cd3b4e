#include "features/supervoxel/supervoxel_parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "core/error.h"
#include "core/voxel.h"

namespace arris {
namespace {

const Lattice kMillimetres{0.001, {0.0, 0.0, 0.0}};

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(SupervoxelParameters, NothingGiven_FollowsTheSpacing) {
  SupervoxelParameters p;
  const SupervoxelScale scale = resolve_scale(p, 0.02, kMillimetres);
  EXPECT_DOUBLE_EQ(p.voxel, kVoxelSpacings * 0.02);
  EXPECT_DOUBLE_EQ(p.seed, kSeedVoxels * p.voxel);
  EXPECT_EQ(scale.voxel_steps, 30);
  EXPECT_EQ(scale.seed_steps, 240);
}

TEST(SupervoxelParameters, PaperSettings_GiveTheScaleOfPcl) {
  SupervoxelParameters p;
  p.voxel = 0.03;
  p.seed = 0.4;
  const SupervoxelScale scale = resolve_scale(p, 0.01, kMillimetres);
  EXPECT_EQ(scale.voxel_steps, 30);
  EXPECT_EQ(scale.seed_steps, 400);
  EXPECT_EQ(scale.levels, 24) << "int(1.8 * 0.4 / 0.03)";
  EXPECT_EQ(scale.search_steps, 200);
  EXPECT_EQ(scale.least_support, 7U) << "0.05 pi (200 / 30)^2 = 6.98, rounded up";
  EXPECT_GE(scale.halo_voxels(), scale.levels + 14) << "growth, and a seed cell around it";
}

TEST(SupervoxelParameters, NoSpacing_IsOneStepPerVoxel) {
  SupervoxelParameters p;
  EXPECT_EQ(resolve_scale(p, 0.0, kMillimetres).voxel_steps, 1);
}

TEST(SupervoxelParameters, FewPointsFarApart_AreTheLargestVoxels) {
  SupervoxelParameters p;
  EXPECT_EQ(resolve_scale(p, 4e6, kMillimetres).voxel_steps, kMostVoxelSide);
}

TEST(SupervoxelParameters, EdgesOfTheRanges_AreAccepted) {
  SupervoxelParameters p;
  p.voxel = kMostVoxelSide * 0.001;
  p.seed = static_cast<double>(kMostSeedSteps) * 0.001;
  EXPECT_EQ(resolve_scale(p, 0.0, kMillimetres).seed_steps, kMostSeedSteps);
  p.seed = 2.0 * p.voxel;
  EXPECT_EQ(resolve_scale(p, 0.0, kMillimetres).seed_steps, 2 * kMostVoxelSide);
}

struct Wrong {
  const char* option;
  std::function<void(SupervoxelParameters&)> set;
};

TEST(SupervoxelParameters, WrongValues_AreErrorsThatNameTheOption) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  using P = SupervoxelParameters;
  const Wrong wrong[] = {{"--voxel", [](P& p) { p.voxel = -1.0; }},
                         {"--voxel", [=](P& p) { p.voxel = nan; }},
                         {"--voxel", [](P& p) { p.voxel = 0.0004; }},
                         {"--voxel", [](P& p) { p.voxel = 2000.0; }},
                         {"--seed", [](P& p) { p.seed = -0.1; }},
                         {"--seed", [=](P& p) { p.seed = infinite; }},
                         {"--seed", [](P& p) { p.voxel = 0.1, p.seed = 0.199; }},
                         {"--seed", [](P& p) { p.voxel = 0.1, p.seed = 100.1; }},
                         {"--seed", [](P& p) { p.voxel = 1000.0, p.seed = 70'000.0; }},
                         {"--iterations", [](P& p) { p.iterations = 0; }},
                         {"--iterations", [](P& p) { p.iterations = 101; }},
                         {"--seed-support", [](P& p) { p.seed_support = 1.01; }},
                         {"--seed-support", [=](P& p) { p.seed_support = nan; }},
                         {"--colour-scale", [](P& p) { p.colour_scale = 0.0; }},
                         {"weights", [](P& p) { p.lambda = -0.1; }},
                         {"weights", [=](P& p) { p.mu = nan; }},
                         {"weights", [=](P& p) { p.epsilon = infinite; }},
                         {"weights", [](P& p) { p.normal_weight = -1.0; }},
                         {"weights", [](P& p) { p.spatial_weight = -1.0; }},
                         {"weights", [](P& p) { p.colour_weight = -1.0; }}};
  for (const Wrong& w : wrong) {
    SupervoxelParameters p;
    w.set(p);
    const std::string text = error_of([&] { resolve_scale(p, 0.01, kMillimetres); });
    EXPECT_NE(text.find(w.option), std::string::npos) << "'" << text << "' does not name " << w.option;
  }
}

}  // namespace
}  // namespace arris
