#include "features/supervoxel/leftover_voxels.h"

#include <utility>

#include "core/parallel.h"
#include "features/supervoxel/cluster_distance.h"
#include "features/supervoxel/seed_cells.h"

namespace arris {
namespace {

constexpr std::size_t kGrain = 16 * 1024;

template <class Distance>
void attach(const VoxelTile& tile, const Distance& distance, std::span<std::uint32_t> clusters_of) {
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> attached((tile.size() + kGrain - 1) / kGrain);
  parallel_for_chunks(tile.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v) {
      if (clusters_of[v] != kNoCluster) continue;
      std::pair<float, std::uint32_t> best{0.0F, kNoCluster};
      for (const std::uint32_t u : tile.neighbours_of(v)) {
        if (clusters_of[u] == kNoCluster || clusters_of[u] == best.second) continue;
        const std::pair<float, std::uint32_t> offer{distance(v, clusters_of[u]), clusters_of[u]};
        if (best.second == kNoCluster || offer < best) best = offer;
      }
      if (best.second != kNoCluster) attached[begin / kGrain].emplace_back(v, best.second);
    }
  });
  // Only now: no voxel is attached by way of another that was.
  for (const auto& chunk : attached) {
    for (const auto& [voxel, cluster] : chunk) clusters_of[voxel] = cluster;
  }
}

}  // namespace

void attach_leftovers(const VoxelTile& tile, const VoxelFeatures& features, const Clusters& clusters,
                      const SupervoxelParameters& parameters, const SupervoxelScale& scale,
                      std::span<std::uint32_t> clusters_of) {
  const ClusterDistanceData data{tile, features, clusters};
  if (parameters.features == SupervoxelParameters::Features::kFpfh) {
    attach(tile, HistogramDistance(data, parameters, scale), clusters_of);
  } else {
    attach(tile, NormalDistance(data, parameters, scale), clusters_of);
  }
}

/// Voxels come in ascending ranks, so the voxel that a group is found by has its smallest rank.
std::vector<OrphanVoxel> group_orphans(const VoxelTile& tile, const SupervoxelScale& scale,
                                       std::span<const std::uint32_t> clusters_of) {
  constexpr std::uint32_t kUnknown = 0xffffffffU;
  std::vector<std::uint32_t> root;
  std::vector<std::uint32_t> stack;
  std::vector<OrphanVoxel> orphans;
  for (std::uint32_t v = 0; v < tile.size(); ++v) {
    if (clusters_of[v] != kNoCluster) continue;
    if (root.empty()) root.assign(tile.size(), kUnknown);
    if (root[v] == kUnknown) {
      const LatticePoint cell = seed_cell(tile.keys[v], scale);
      root[v] = v;
      stack.push_back(v);
      while (!stack.empty()) {
        const std::uint32_t at = stack.back();
        stack.pop_back();
        for (const std::uint32_t u : tile.neighbours_of(at)) {
          if (clusters_of[u] != kNoCluster || root[u] != kUnknown || seed_cell(tile.keys[u], scale) != cell) continue;
          root[u] = v;
          stack.push_back(u);
        }
      }
    }
    if (tile.core[v] != 0) orphans.push_back({tile.ranks[v], tile.ranks[root[v]]});
  }
  return orphans;
}

}  // namespace arris
