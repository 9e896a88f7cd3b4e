#include "features/supervoxel/leftover_voxels.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <set>

#include "features/supervoxel/cluster_distance.h"
#include "features/supervoxel/seed_cells.h"
#include "growth_testing.h"

namespace arris {
namespace {

using Features = SupervoxelParameters::Features;
using test::GrowthScene;

struct Settled {
  PageVector<std::uint32_t> clusters;
  std::vector<OrphanVoxel> orphans;
};

Settled settle(const GrowthScene& s, const VoxelTile& tile, const VoxelFeatures& features,
               const PageVector<std::uint32_t>& clusters) {
  Settled result{clusters, {}};
  attach_leftovers(tile, features, s.clusters, s.parameters, s.scale, result.clusters);
  result.orphans = group_orphans(tile, s.scale, result.clusters);
  return result;
}

PageVector<std::uint32_t> attached(const GrowthScene& s, const PageVector<std::uint32_t>& before) {
  const ClusterDistanceData data{s.tile, s.features, s.clusters};
  const HistogramDistance histogram(data, s.parameters, s.scale);
  const NormalDistance normal(data, s.parameters, s.scale);
  PageVector<std::uint32_t> after = before;
  for (std::uint32_t v = 0; v < before.size(); ++v) {
    if (before[v] != kNoCluster) continue;
    std::set<std::pair<float, std::uint32_t>> offers;
    for (const std::uint32_t u : s.tile.neighbours_of(v)) {
      if (before[u] == kNoCluster) continue;
      offers.insert(
          {s.parameters.features == Features::kFpfh ? histogram(v, before[u]) : normal(v, before[u]), before[u]});
    }
    if (!offers.empty()) after[v] = offers.begin()->second;
  }
  return after;
}

/// Root of every voxel without cluster: the smallest rank of its group, by spreading minima until nothing changes.
std::map<std::uint32_t, std::uint32_t> roots(const GrowthScene& s, const PageVector<std::uint32_t>& clusters) {
  std::map<std::uint32_t, std::uint32_t> root;
  for (std::uint32_t v = 0; v < clusters.size(); ++v) {
    if (clusters[v] == kNoCluster) root[v] = s.tile.ranks[v];
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (auto& [v, least] : root) {
      for (const std::uint32_t u : s.tile.neighbours_of(v)) {
        const auto other = root.find(u);
        if (other == root.end() || seed_cell(s.tile.keys[u], s.scale) != seed_cell(s.tile.keys[v], s.scale)) continue;
        if (other->second >= least) continue;
        least = other->second;
        changed = true;
      }
    }
  }
  return root;
}

/// Clusters as they grew, with some voxels and whole regions taken away.
struct Leftovers {
  GrowthScene scene;
  PageVector<std::uint32_t> clusters;
};
Leftovers any_leftovers() {
  const auto kind = *rc::gen::element(Features::kNormal, Features::kFpfh).as("features");
  const auto seed = *rc::gen::arbitrary<std::uint64_t>().as("seed");
  Leftovers made{test::growth_scene(kind, seed % 2 == 0, 2500, seed), {}};
  GrowthScene& s = made.scene;
  std::mt19937_64 random(seed);
  made.clusters = grow_clusters(s.tile, s.features, s.clusters, s.seeds, s.parameters, s.scale);
  std::set<std::uint32_t> gone;
  for (std::uint32_t cluster = 0; cluster < s.clusters.size(); ++cluster) {
    if (random() % 3 == 0) gone.insert(cluster);
  }
  for (std::uint32_t& cluster : made.clusters) {
    if (gone.contains(cluster) || random() % 10 == 0) cluster = kNoCluster;
  }
  return made;
}

RC_GTEST_PROP(LeftoverVoxels, AnyClusters_AttachToTheNearestAndGroupTheRest, ()) {
  Leftovers made = any_leftovers();
  GrowthScene& s = made.scene;
  std::mt19937_64 random(s.tile.size());
  const LatticeBox core = test::any_core(s.tile, random);
  for (std::size_t v = 0; v < s.tile.size(); ++v) s.tile.core[v] = core.contains(s.tile.keys[v]) ? 1 : 0;
  const Settled settled = settle(s, s.tile, s.features, made.clusters);
  RC_ASSERT(settled.clusters == attached(s, made.clusters));
  std::vector<OrphanVoxel> expected;
  for (const auto& [v, root] : roots(s, settled.clusters)) {
    if (s.tile.core[v] != 0) expected.push_back({s.tile.ranks[v], root});
  }
  RC_ASSERT(settled.orphans.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    RC_ASSERT(settled.orphans[i].rank == expected[i].rank);
    RC_ASSERT(settled.orphans[i].root_rank == expected[i].root_rank);
  }
}

RC_GTEST_PROP(LeftoverVoxels, CutASeedCellAndAVoxelAway_CoreStays, ()) {
  const Leftovers made = any_leftovers();
  const GrowthScene& s = made.scene;
  std::mt19937_64 random(s.tile.size());
  const Settled whole = settle(s, s.tile, s.features, made.clusters);
  std::vector<std::uint32_t> from;
  const std::int64_t cell = s.scale.seed_steps / s.scale.voxel_steps;
  const VoxelTile part = test::part_of(s.tile, test::any_core(s.tile, random), cell + 1, from);
  PageVector<std::uint32_t> clusters;
  for (const std::uint32_t v : from) clusters.push_back(made.clusters[v]);
  const Settled settled = settle(s, part, test::part_of(s.features, from), clusters);
  std::map<std::uint32_t, std::uint32_t> root_of;
  for (const OrphanVoxel& orphan : whole.orphans) root_of[orphan.rank] = orphan.root_rank;
  std::size_t orphans = 0;
  for (std::size_t v = 0; v < part.size(); ++v) {
    if (part.core[v] == 0) continue;
    RC_ASSERT(settled.clusters[v] == whole.clusters[from[v]]);
    orphans += settled.clusters[v] == kNoCluster;
  }
  RC_ASSERT(settled.orphans.size() == orphans);
  for (const OrphanVoxel& orphan : settled.orphans) RC_ASSERT(root_of.at(orphan.rank) == orphan.root_rank);
}

}  // namespace
}  // namespace arris
