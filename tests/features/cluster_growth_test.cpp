#include "features/supervoxel/cluster_growth.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "features/supervoxel/cluster_distance.h"
#include "growth_testing.h"

namespace arris {
namespace {

using Features = SupervoxelParameters::Features;
using test::GrowthScene;

PageVector<std::uint32_t> grow(const GrowthScene& s) {
  return grow_clusters(s.tile, s.features, s.clusters, s.seeds, s.parameters, s.scale);
}

/// The definition, one level after the other, with maps.
template <class Distance>
PageVector<std::uint32_t> reference(const GrowthScene& s, const Distance& distance) {
  using Offer = std::pair<float, std::uint32_t>;  // D, cluster.
  constexpr float kOwnSeed = -1.0F;               // A seed's voxel stays with it.
  std::map<std::uint32_t, Offer> best;
  std::map<std::uint32_t, std::uint32_t> frontier;
  for (const TileSeed& seed : s.seeds) {
    best[seed.voxel] = {kOwnSeed, seed.cluster};
    frontier[seed.voxel] = seed.cluster;
  }
  for (int level = 0; level < s.scale.levels; ++level) {
    std::map<std::uint32_t, Offer> offers;
    for (const auto& [voxel, cluster] : frontier) {
      for (const std::uint32_t neighbour : s.tile.neighbours_of(voxel)) {
        const Offer offer{distance(neighbour, cluster), cluster};
        const auto [at, fresh] = offers.try_emplace(neighbour, offer);
        if (!fresh) at->second = std::min(at->second, offer);
      }
    }
    frontier.clear();
    for (const auto& [voxel, offer] : offers) {
      const auto [at, fresh] = best.try_emplace(voxel, offer);
      if (!fresh && !(offer < at->second)) continue;
      at->second = offer;
      frontier[voxel] = offer.second;
    }
  }
  PageVector<std::uint32_t> clusters(s.tile.size(), kNoCluster);
  for (const auto& [voxel, offer] : best) clusters[voxel] = offer.second;
  return clusters;
}

PageVector<std::uint32_t> reference(const GrowthScene& s) {
  const ClusterDistanceData data{s.tile, s.features, s.clusters};
  return s.parameters.features == Features::kFpfh ? reference(s, HistogramDistance(data, s.parameters, s.scale))
                                                  : reference(s, NormalDistance(data, s.parameters, s.scale));
}

GrowthScene any_scene(std::size_t points) {
  const auto kind = *rc::gen::element(Features::kNormal, Features::kFpfh).as("features");
  const auto colours = *rc::gen::arbitrary<bool>().as("colours");
  return test::growth_scene(kind, colours, points, *rc::gen::arbitrary<std::uint64_t>().as("seed"));
}

RC_GTEST_PROP(ClusterGrowth, AnyScene_IsThatOfTheSerialReference, ()) {
  const GrowthScene scene = any_scene(2500);
  RC_ASSERT(grow(scene) == reference(scene));
}

TEST(ClusterGrowth, ThreadsAndOrderOfSeeds_DoNotMatter) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    GrowthScene scene = test::growth_scene(seed % 2 ? Features::kNormal : Features::kFpfh, seed % 3 == 0, 30'000, seed);
    scene.scale.levels = 6;
    ASSERT_GT(scene.tile.size(), 2U * 4096U) << "enough for several parts";
    const auto with_threads = [&](int threads) {
      const ThreadLimit limit(threads);
      return grow(scene);
    };
    const PageVector<std::uint32_t> one = with_threads(1);
    EXPECT_EQ(with_threads(4), one);
    std::shuffle(scene.seeds.begin(), scene.seeds.end(), std::mt19937_64(seed));
    EXPECT_EQ(with_threads(3), one);
  }
}

RC_GTEST_PROP(ClusterGrowth, CutAsManyVoxelsAwayAsLevels_CoreStays, ()) {
  GrowthScene scene = any_scene(5000);
  std::mt19937_64 random(scene.tile.size());
  const PageVector<std::uint32_t> whole = grow(scene);
  const LatticeBox core = test::any_core(scene.tile, random);
  std::vector<std::uint32_t> from;
  GrowthScene part = scene;
  part.tile = test::part_of(scene.tile, core, scene.scale.levels, from);
  part.features = test::part_of(scene.features, from);
  part.seeds = tile_seeds(part.tile, scene.clusters, scene.by_rank);
  const PageVector<std::uint32_t> clusters = grow(part);
  for (std::size_t v = 0; v < clusters.size(); ++v) {
    if (part.tile.core[v] != 0) RC_ASSERT(clusters[v] == whole[from[v]]);
  }
}

// Without weights all distances are 0, and ties must not take the voxel that a cluster grows from.
RC_GTEST_PROP(ClusterGrowth, DistancesAllZero_EverySeedKeepsItsVoxel, ()) {
  GrowthScene scene = any_scene(2000);
  scene.parameters.normal_weight = scene.parameters.spatial_weight = scene.parameters.colour_weight = 0.0;
  scene.parameters.lambda = scene.parameters.mu = scene.parameters.epsilon = 0.0;
  const PageVector<std::uint32_t> clusters = grow(scene);
  for (const TileSeed& seed : scene.seeds) RC_ASSERT(clusters[seed.voxel] == seed.cluster);
  RC_ASSERT(clusters == reference(scene));
}

TEST(ClusterGrowth, NoSeeds_NoVoxelHasACluster) {
  GrowthScene scene = test::growth_scene(Features::kNormal, false, 500, 1);
  scene.seeds.clear();
  EXPECT_EQ(grow(scene), PageVector<std::uint32_t>(scene.tile.size(), kNoCluster));
}

RC_GTEST_PROP(TileSeeds, AnyPart_HasThoseInIt, ()) {
  const GrowthScene scene = any_scene(2000);
  std::mt19937_64 random(scene.tile.size());
  std::vector<std::uint32_t> from;
  const VoxelTile part = test::part_of(scene.tile, test::any_core(scene.tile, random), 3, from);
  std::map<std::uint32_t, std::uint32_t> expected;  // Voxel of the part to cluster.
  for (std::uint32_t cluster = 0; cluster < scene.clusters.size(); ++cluster) {
    for (std::uint32_t v = 0; v < part.size(); ++v) {
      if (part.ranks[v] == scene.clusters.seed_ranks[cluster]) expected[v] = cluster;
    }
  }
  const std::vector<TileSeed> seeds = tile_seeds(part, scene.clusters, scene.by_rank);
  RC_ASSERT(seeds.size() == expected.size());
  for (const TileSeed& seed : seeds) RC_ASSERT(expected.at(seed.voxel) == seed.cluster);
}

double squared_offset_of(const VoxelPosition& a, const VoxelPosition& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double d = difference(a[i], b[i]);
    sum += d * d;
  }
  return sum;
}

// D as the paper and PCL print it, in double.
RC_GTEST_PROP(ClusterDistance, AnyVoxelAndCluster_IsTheFormula, ()) {
  GrowthScene s = any_scene(400);
  const auto weight = [] { return *rc::gen::inRange(0, 300) / 100.0; };
  SupervoxelParameters& p = s.parameters;
  p.lambda = weight(), p.mu = weight(), p.epsilon = weight(), p.colour_scale = 1.0 + weight();
  p.normal_weight = weight(), p.spatial_weight = weight(), p.colour_weight = weight();
  const ClusterDistanceData data{s.tile, s.features, s.clusters};
  const double seed = 16.0 * static_cast<double>(s.scale.seed_steps);
  for (std::uint32_t v = 0; v < s.tile.size(); v += 7) {
    const std::uint32_t c = v % s.clusters.size();
    const ClusterCentre& centre = s.clusters.centres[c];
    double colour2 = 0.0;
    double cosine = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double off = s.features.colours.empty() ? 0.0 : double{s.features.colours[v][i]} - centre.colour[i];
      colour2 += off * off;
      cosine += double{s.features.normals[v][i]} * centre.normal[i];
    }
    const double space2 = squared_offset_of(s.tile.positions[v], centre.position);
    double expected = 0.0;
    double found = 0.0;
    if (p.features == Features::kFpfh) {
      double common = 0.0;
      for (std::size_t i = 0; i < kHistogramBins; ++i)
        common += std::min(s.features.histograms[v][i], s.clusters.histograms[c][i]);
      const double shape = 1.0 - std::min(1.0, common / kHistogramTotal);
      expected = std::sqrt(p.lambda * colour2 / (p.colour_scale * p.colour_scale) +
                           p.mu * space2 / (3.0 * seed * seed) + p.epsilon * shape * shape);
      found = HistogramDistance(data, p, s.scale)(v, c);
    } else {
      expected = p.normal_weight * (1.0 - std::min(1.0, std::abs(cosine))) +
                 p.spatial_weight * std::sqrt(space2) / seed + p.colour_weight * std::sqrt(colour2) / 255.0;
      found = NormalDistance(data, p, s.scale)(v, c);
    }
    RC_ASSERT(std::abs(found - expected) <= 1e-4 + 1e-4 * expected);
  }
}

RC_GTEST_PROP(TileSeeds, AnyRanks_AreThoseOfTheClustersThatLieInTheTile, ()) {
  const auto most = *rc::gen::inRange<std::uint32_t>(1, 200).as("voxels of the scan");
  const auto in_tile = *rc::gen::container<std::set<std::uint32_t>>(rc::gen::inRange<std::uint32_t>(0, most));
  const auto seeds = *rc::gen::container<std::set<std::uint32_t>>(rc::gen::inRange<std::uint32_t>(0, most));
  VoxelTile tile{VoxelGrid(1)};
  tile.keys.resize(in_tile.size());
  tile.ranks.assign(in_tile.begin(), in_tile.end());
  Clusters clusters;
  clusters.seed_ranks.assign(seeds.rbegin(), seeds.rend());  // By rank they come the other way round.
  clusters.seed_positions.resize(seeds.size());
  clusters.centres.resize(seeds.size());
  std::vector<std::uint32_t> by_rank(seeds.size());
  for (std::uint32_t i = 0; i < by_rank.size(); ++i) by_rank[i] = clusters.size() - 1 - i;

  std::vector<std::pair<std::uint32_t, std::uint32_t>> expected, found;
  for (const std::uint32_t cluster : by_rank) {
    const auto at = in_tile.find(clusters.seed_ranks[cluster]);
    if (at != in_tile.end())
      expected.emplace_back(static_cast<std::uint32_t>(std::distance(in_tile.begin(), at)), cluster);
  }
  for (const TileSeed& seed : tile_seeds(tile, clusters, by_rank)) found.emplace_back(seed.voxel, seed.cluster);
  RC_ASSERT(found == expected);
}

}  // namespace
}  // namespace arris
