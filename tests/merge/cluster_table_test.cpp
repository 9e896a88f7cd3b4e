#include "merge/cluster_table.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "growth_testing.h"

namespace arris::merge {
namespace {

using Features = SupervoxelParameters::Features;
using test::GrowthScene;

/// A tile cut into slices by the keys' last bits: cores are scattered, which the table must not notice.
std::vector<VoxelTile> tiles_of(const VoxelTile& tile, std::size_t count) {
  std::vector<VoxelTile> tiles(count, tile);
  for (std::size_t v = 0; v < tile.size(); ++v) {
    for (std::size_t i = 0; i < count; ++i)
      tiles[i].core[v] = (static_cast<std::uint32_t>(tile.keys[v].x) >> 1) % count == i ? 1 : 0;
  }
  return tiles;
}

std::vector<Seed> seeds_of(const GrowthScene& scene, const VoxelTile& tile) {
  std::vector<Seed> seeds;
  for (const TileSeed& s : scene.seeds) {  // Cells in some order that is not that of voxels.
    const auto number = static_cast<std::int32_t>(s.voxel);
    if (tile.core[s.voxel] != 0) seeds.push_back({{number % 7 - 3, number % 11, number}, s.voxel});
  }
  std::sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) { return a.cell < b.cell; });
  return seeds;
}

struct Iteration {
  std::vector<ClusterPlane> planes;
  Clusters moved;  ///< New centres, old seeds.
  Clusters reseeded;
};

/// One whole iteration over the tiles in this order.
Iteration iterate(const GrowthScene& scene, const std::vector<VoxelTile>& tiles,
                  PageVector<std::uint32_t>& clusters_of) {
  ClusterTable table(scene.parameters);
  for (const VoxelTile& tile : tiles) table.add_seeds(tile, scene.features, seeds_of(scene, tile));
  table.fix_seeds();
  if (clusters_of.empty()) {
    const auto seeds = tile_seeds(scene.tile, table.clusters(), table.by_seed_rank());
    clusters_of = grow_clusters(scene.tile, scene.features, table.clusters(), seeds, scene.parameters, scene.scale);
  }
  for (const VoxelTile& tile : tiles) table.add_members(tile, scene.features, clusters_of);
  Iteration result;
  result.planes = table.planes();
  table.update_centres();
  result.moved = table.clusters();
  for (const VoxelTile& tile : tiles) table.offer_seeds(tile, clusters_of);
  table.move_seeds();
  result.reseeded = table.clusters();
  return result;
}

bool same(const Clusters& a, const Clusters& b) {
  return a.seed_ranks == b.seed_ranks && a.seed_positions == b.seed_positions && a.histograms == b.histograms &&
         std::equal(a.centres.begin(), a.centres.end(), b.centres.begin(), b.centres.end(),
                    [](const ClusterCentre& p, const ClusterCentre& q) {
                      return p.position == q.position && p.normal == q.normal && p.colour == q.colour;
                    });
}
bool same(const std::vector<ClusterPlane>& a, const std::vector<ClusterPlane>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const ClusterPlane& p, const ClusterPlane& q) {
    return p.position == q.position && p.normal == q.normal;
  });
}

GrowthScene any_scene() {
  const auto kind = *rc::gen::element(Features::kNormal, Features::kFpfh).as("features");
  const auto colours = *rc::gen::arbitrary<bool>().as("colours");
  return test::growth_scene(kind, colours, 2500, *rc::gen::arbitrary<std::uint64_t>().as("seed"));
}

RC_GTEST_PROP(ClusterTable, AnyTilesInAnyOrder_GiveTheSameBits, ()) {
  const GrowthScene scene = any_scene();
  PageVector<std::uint32_t> clusters_of;
  const Iteration whole = iterate(scene, {scene.tile}, clusters_of);
  std::vector<VoxelTile> tiles = tiles_of(scene.tile, *rc::gen::inRange<std::size_t>(2, 6).as("tiles"));
  std::shuffle(tiles.begin(), tiles.end(), std::mt19937_64(scene.tile.size()));
  const Iteration cut = iterate(scene, tiles, clusters_of);
  RC_ASSERT(same(cut.planes, whole.planes));
  RC_ASSERT(same(cut.moved, whole.moved));
  RC_ASSERT(same(cut.reseeded, whole.reseeded));
}

/// Nearest whole number, half up.
std::int64_t rounded(double mean) {
  return static_cast<std::int64_t>(std::floor(mean + 0.5));
}

struct NaiveSums {
  double n = 0.0;
  std::array<double, 3> position{}, normal{}, colour{};
  std::array<double, kHistogramBins> histogram{};
};

/// Mean direction; signs as the centre's.
bool near_direction(const std::array<double, 3>& sum, const std::array<float, 3>& unit) {
  const double length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  if (length < 1e-2) return true;  // Cancels out: no direction to compare.
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(sum[i] / length - unit[i]) > 1e-2) return false;
  }
  return true;
}

RC_GTEST_PROP(ClusterTable, AnyMembers_GiveTheirMeansAndTheNearestSeeds, ()) {
  const GrowthScene scene = any_scene();
  PageVector<std::uint32_t> clusters_of;
  const Iteration found = iterate(scene, {scene.tile}, clusters_of);
  const VoxelTile& tile = scene.tile;
  ClusterTable before(scene.parameters);
  before.add_seeds(tile, scene.features, seeds_of(scene, tile));
  before.fix_seeds();
  const Clusters& old = before.clusters();
  for (std::uint32_t c = 0; c < old.size(); ++c) {
    NaiveSums all, facing;
    std::pair<std::uint64_t, std::uint32_t> nearest{~std::uint64_t{0}, 0};
    for (std::uint32_t v = 0; v < tile.size(); ++v) {
      if (clusters_of[v] != c) continue;
      const std::array<float, 3>& n = scene.features.normals[v];
      const std::array<float, 3>& o = old.centres[c].normal;
      const float cosine = n[0] * o[0] + n[1] * o[1] + n[2] * o[2];
      std::uint64_t distance2 = 0;
      for (NaiveSums* sums : {&all, &facing}) {
        if (sums == &facing && std::abs(cosine) < std::cos(3.14159265F / 6.0F)) continue;
        sums->n += 1.0;
        for (std::size_t i = 0; i < 3; ++i) {
          sums->position[i] += difference(tile.positions[v][i], old.seed_positions[c][i]);
          sums->normal[i] += cosine < 0.0F ? -n[i] : n[i];
          if (!scene.features.colours.empty()) sums->colour[i] += scene.features.colours[v][i];
        }
      }
      for (std::size_t i = 0; i < kHistogramBins && !scene.features.histograms.empty(); ++i)
        all.histogram[i] += scene.features.histograms[v][i];
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int64_t d = difference(tile.positions[v][i], found.moved.centres[c].position[i]);
        distance2 += static_cast<std::uint64_t>(d * d);
      }
      nearest = std::min(nearest, {distance2, tile.ranks[v]});
    }
    RC_ASSERT(all.n > 0.0);
    const ClusterCentre& centre = found.moved.centres[c];
    for (std::size_t i = 0; i < 3; ++i) {
      RC_ASSERT(difference(centre.position[i], old.seed_positions[c][i]) == rounded(all.position[i] / all.n));
      RC_ASSERT(std::abs(centre.colour[i] - all.colour[i] / all.n) < 1.0 / 256.0);
    }
    RC_ASSERT(near_direction(all.normal, centre.normal));
    if (facing.n == 0.0) {
      RC_ASSERT(found.planes[c].normal == (std::array<float, 3>{}));
    } else {
      for (std::size_t i = 0; i < 3; ++i)
        RC_ASSERT(difference(found.planes[c].position[i], old.seed_positions[c][i]) ==
                  rounded(facing.position[i] / facing.n));
      RC_ASSERT(near_direction(facing.normal, found.planes[c].normal));
    }
    for (std::size_t i = 0; i < kHistogramBins && !found.moved.histograms.empty(); ++i)
      RC_ASSERT(found.moved.histograms[c][i] == rounded(all.histogram[i] / all.n));
    RC_ASSERT(found.reseeded.seed_ranks[c] == nearest.second);
  }
}

TEST(ClusterTable, SeedsOfAnyTiles_AreNumberedByTheirCells) {
  const VoxelTile tile = test::voxel_tile_of(10, {{0, 0, 0}, {100, 0, 0}, {200, 0, 0}, {300, 0, 0}});
  const VoxelFeatures features{PageVector<std::array<float, 3>>(4, std::array<float, 3>{}), {}, {}};
  const SupervoxelParameters parameters;
  ClusterTable table(parameters);
  table.add_seeds(tile, features, std::vector<Seed>{{{5, 0, 0}, 3}, {{9, 0, 0}, 0}});
  table.add_seeds(tile, features, std::vector<Seed>{{{-1, 7, 0}, 2}, {{5, -2, 0}, 1}});
  table.fix_seeds();
  EXPECT_EQ(table.clusters().seed_ranks, (std::vector<std::uint32_t>{2, 1, 3, 0}));
  const auto by_rank = table.by_seed_rank();
  EXPECT_EQ(std::vector<std::uint32_t>(by_rank.begin(), by_rank.end()), (std::vector<std::uint32_t>{3, 1, 0, 2}));
  EXPECT_EQ(table.clusters().centres[0].position, tile.positions[2]);
}

TEST(ClusterTable, VoxelsEquallyNearToTheCentre_TheSmallestRankIsTheSeed) {
  // Eight corners of a cube around their mean: all are equally near.
  std::vector<LatticePoint> points;
  for (int i = 0; i < 8; ++i) points.push_back({10 * (i & 1), 10 * (i >> 1 & 1), 10 * (i >> 2)});
  const VoxelTile tile = test::voxel_tile_of(10, points);
  const VoxelFeatures features{PageVector<std::array<float, 3>>(8, {0, 0, 1}), {}, {}};
  for (const bool reversed : {false, true}) {
    ClusterTable table(SupervoxelParameters{});
    table.add_seeds(tile, features, std::vector<Seed>{{{0, 0, 0}, 5}});
    table.fix_seeds();
    const std::vector<std::uint32_t> clusters_of(8, 0);
    std::vector<VoxelTile> tiles = tiles_of(tile, 2);
    for (std::size_t v = 0; v < 8; ++v) {
      tiles[0].core[v] = v >= 3 ? 1 : 0;
      tiles[1].core[v] = v < 3 ? 1 : 0;
    }
    if (reversed) std::swap(tiles[0], tiles[1]);
    for (const VoxelTile& t : tiles) table.add_members(t, features, clusters_of);
    table.update_centres();
    for (const VoxelTile& t : tiles) table.offer_seeds(t, clusters_of);
    table.move_seeds();
    EXPECT_EQ(table.clusters().seed_ranks, (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(table.clusters().seed_positions[0], tile.positions[0]);
  }
}

}  // namespace
}  // namespace arris::merge
