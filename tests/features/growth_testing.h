#pragma once
/// @file Random clusters on random surfaces.

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "features/supervoxel/cluster_growth.h"
#include "features/supervoxel/voxel_normals.h"
#include "voxel_tile_testing.h"

namespace arris::test {

/// A surface of voxels with seeds at random voxels, and centres that are those voxels a little changed.
struct GrowthScene {
  VoxelTile tile;
  VoxelFeatures features;
  Clusters clusters;
  std::vector<std::uint32_t> by_rank;
  std::vector<TileSeed> seeds;
  SupervoxelParameters parameters;
  SupervoxelScale scale;
};

inline GrowthScene growth_scene(SupervoxelParameters::Features kind, bool colours, std::size_t points,
                                std::uint64_t seed) {
  constexpr std::int32_t kVoxel = 20;
  std::mt19937_64 random(seed);
  const auto side = static_cast<std::int32_t>(20.0 * std::sqrt(static_cast<double>(points)));
  const BumpySurface surface = bumpy_surface(points, side, random());
  GrowthScene scene{voxel_tile_of(kVoxel, surface.points, colours ? surface.colours : std::vector<RawColour>{}),
                    {},
                    {},
                    {},
                    {},
                    {},
                    {}};
  scene.parameters.features = kind;
  scene.features = voxel_features(scene.tile, voxel_normals(scene.tile), scene.parameters, 65535.0);
  scene.scale.voxel_steps = kVoxel;
  scene.scale.seed_steps = kVoxel * static_cast<std::int64_t>(2 + random() % 6);
  scene.scale.levels = static_cast<int>(1 + random() % 9);
  std::vector<std::uint32_t> voxels(scene.tile.size());
  for (std::uint32_t v = 0; v < voxels.size(); ++v) voxels[v] = v;
  std::shuffle(voxels.begin(), voxels.end(), random);
  voxels.resize(std::max<std::size_t>(1, voxels.size() / 30));
  std::normal_distribution<double> noise(0.0, 1.0);
  for (const std::uint32_t v : voxels) {
    const auto cluster = static_cast<std::uint32_t>(scene.clusters.size());
    ClusterCentre centre{scene.tile.positions[v], scene.features.normals[v], {}};
    for (std::uint32_t& c : centre.position) c += static_cast<std::uint32_t>(std::lround(200.0 * noise(random)));
    if (colours) centre.colour = scene.features.colours[voxels[random() % voxels.size()]];
    scene.clusters.seed_ranks.push_back(scene.tile.ranks[v]);
    scene.clusters.seed_positions.push_back(scene.tile.positions[v]);
    scene.clusters.centres.push_back(centre);
    if (!scene.features.histograms.empty()) scene.clusters.histograms.push_back(scene.features.histograms[v]);
    scene.by_rank.push_back(cluster);
    scene.seeds.push_back({v, cluster});
  }
  std::sort(scene.by_rank.begin(), scene.by_rank.end(), [&](std::uint32_t a, std::uint32_t b) {
    return scene.clusters.seed_ranks[a] < scene.clusters.seed_ranks[b];
  });
  return scene;
}

}  // namespace arris::test
