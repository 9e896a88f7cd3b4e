#include "merge/cluster_table.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "core/parallel.h"
#include "merge/cluster_sums.h"

namespace arris::merge {
namespace {

constexpr std::size_t kGrain = 16 * 1024;
constexpr std::size_t kLocks = 256;

std::int64_t rounded_mean(std::int64_t sum, std::int64_t n) {  // Half up.
  const std::int64_t doubled = 2 * sum + n;
  const std::int64_t q = doubled / (2 * n);
  return q - (doubled % (2 * n) < 0);
}

std::array<float, 3> direction(const std::array<std::int64_t, 3>& sum) {
  const std::array<double, 3> n{static_cast<double>(sum[0]), static_cast<double>(sum[1]), static_cast<double>(sum[2])};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  std::array<float, 3> unit{};
  for (std::size_t i = 0; i < 3; ++i) unit[i] = length > 0.0 ? static_cast<float>(n[i] / length) : 0.0F;
  return unit;
}

}  // namespace

struct ClusterTable::Impl {
  struct NewSeed {
    LatticePoint cell;
    std::uint32_t rank;
    ClusterCentre centre;
  };

  bool histograms = false;
  std::vector<NewSeed> new_seeds;
  std::vector<FeatureHistogram> new_histograms;  // If there are any.
  Clusters clusters;
  std::vector<std::uint32_t> by_rank;
  std::vector<Sums> sums;
  std::vector<HistogramSums> histogram_sums;
  std::vector<SeedOffer> offers;
  std::array<std::mutex, kLocks> locks;

  std::mutex& lock_of(std::uint32_t cluster) { return locks[cluster % kLocks]; }

  void order_by_rank() {
    std::vector<std::uint64_t> ranks(clusters.size());  // And their clusters, below.
    for (std::uint32_t c = 0; c < ranks.size(); ++c) ranks[c] = std::uint64_t{clusters.seed_ranks[c]} << 32 | c;
    std::ranges::sort(ranks);
    by_rank.resize(ranks.size());
    std::ranges::transform(ranks, by_rank.begin(), [](std::uint64_t rank) { return static_cast<std::uint32_t>(rank); });
  }

  void add_member(const VoxelTile& tile, const VoxelFeatures& features, std::size_t v, std::uint32_t cluster,
                  Sums& to) const {
    const std::array<float, 3>& n = features.normals[v];
    const ClusterCentre& centre = clusters.centres[cluster];
    const float cosine = n[0] * centre.normal[0] + n[1] * centre.normal[1] + n[2] * centre.normal[2];
    SurfaceSums member{1, {}, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      member.position[i] = difference(tile.positions[v][i], clusters.seed_positions[cluster][i]);
      member.normal[i] = units(cosine < 0.0F ? -n[i] : n[i], kNormalUnits);
      if (!features.colours.empty()) to.colour[i] += units(features.colours[v][i], kColourUnits);
    }
    to.all.add(member);
    if (std::abs(cosine) >= kFacingCosine) to.facing.add(member);
  }

  VoxelPosition mean_position(std::uint32_t cluster, const SurfaceSums& s) const {
    VoxelPosition position = clusters.seed_positions[cluster];
    for (std::size_t i = 0; i < 3; ++i)
      position[i] += static_cast<std::uint32_t>(rounded_mean(s.position[i], s.voxels));
    return position;
  }

  ClusterPlane plane(std::uint32_t cluster) const {
    const SurfaceSums& s = sums[cluster].facing;
    if (s.voxels == 0) return {};
    return {mean_position(cluster, s), direction(s.normal)};
  }

  void update(std::uint32_t cluster) {
    const Sums& s = sums[cluster];
    if (s.all.voxels == 0) return;  // Cannot be: a seed keeps its own voxel.
    ClusterCentre& centre = clusters.centres[cluster];
    centre.position = mean_position(cluster, s.all);
    centre.normal = direction(s.all.normal);
    for (std::size_t i = 0; i < 3; ++i) {
      centre.colour[i] =
          static_cast<float>(static_cast<double>(s.colour[i]) / (kColourUnits * static_cast<double>(s.all.voxels)));
    }
    if (histograms) {
      for (std::size_t i = 0; i < kHistogramBins; ++i)
        clusters.histograms[cluster][i] =
            static_cast<std::int16_t>(rounded_mean(histogram_sums[cluster][i], s.all.voxels));
    }
  }
};

ClusterTable::ClusterTable(const SupervoxelParameters& parameters) : impl_(std::make_unique<Impl>()) {
  impl_->histograms = parameters.features == SupervoxelParameters::Features::kFpfh;
}
ClusterTable::~ClusterTable() = default;

void ClusterTable::add_seeds(const VoxelTile& tile, const VoxelFeatures& features, std::span<const Seed> seeds) {
  for (const Seed& seed : seeds) {
    Impl::NewSeed s{seed.cell, tile.ranks[seed.voxel], {tile.positions[seed.voxel], features.normals[seed.voxel], {}}};
    if (!features.colours.empty()) s.centre.colour = features.colours[seed.voxel];
    impl_->new_seeds.push_back(s);
    if (impl_->histograms) impl_->new_histograms.push_back(features.histograms[seed.voxel]);
  }
}

void ClusterTable::drop_seeds() {
  impl_->new_seeds = {};
  impl_->new_histograms = {};
}

void ClusterTable::fix_seeds() {
  const auto& seeds = impl_->new_seeds;
  std::vector<std::uint32_t> order(seeds.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto before = [&](std::uint32_t a, std::uint32_t b) { return seeds[a].cell < seeds[b].cell; };
  if (!std::ranges::is_sorted(order, before)) std::ranges::sort(order, before);  // Those of a lone tile are.
  Clusters& c = impl_->clusters;
  c.seed_ranks.reserve(order.size());
  c.seed_positions.reserve(order.size());
  c.centres.reserve(order.size());
  if (impl_->histograms) c.histograms.reserve(order.size());
  for (const std::uint32_t i : order) {
    c.seed_ranks.push_back(seeds[i].rank);
    c.seed_positions.push_back(seeds[i].centre.position);
    c.centres.push_back(seeds[i].centre);
    if (impl_->histograms) c.histograms.push_back(impl_->new_histograms[i]);
  }
  drop_seeds();
  impl_->order_by_rank();
  impl_->sums.assign(c.size(), {});
  impl_->offers.assign(c.size(), {});
  if (impl_->histograms) impl_->histogram_sums.assign(c.size(), {});
}

const Clusters& ClusterTable::clusters() const {
  return impl_->clusters;
}
std::span<const std::uint32_t> ClusterTable::by_seed_rank() const {
  return impl_->by_rank;
}

void ClusterTable::add_members(const VoxelTile& tile, const VoxelFeatures& features,
                               std::span<const std::uint32_t> clusters_of) {
  const bool histograms = impl_->histograms;
  parallel_for_chunks(tile.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    ClusterSlots<Sums> sums;
    const auto put_out = [&](std::uint32_t cluster, const Sums& members) {
      const std::lock_guard guard(impl_->lock_of(cluster));
      impl_->sums[cluster].add(members);
    };
    ClusterSlots<HistogramSums> bins;
    const auto put_bins_out = [&](std::uint32_t cluster, const HistogramSums& members) {
      const std::lock_guard guard(impl_->lock_of(cluster));
      for (std::size_t i = 0; i < members.size(); ++i) impl_->histogram_sums[cluster][i] += members[i];
    };
    for (std::size_t v = begin; v < end; ++v) {
      const std::uint32_t cluster = clusters_of[v];
      if (tile.core[v] == 0 || cluster == kNoCluster) continue;
      impl_->add_member(tile, features, v, cluster, sums.at(cluster, put_out));
      if (!histograms) continue;
      HistogramSums& to = bins.at(cluster, put_bins_out);
      for (std::size_t i = 0; i < to.size(); ++i) to[i] += features.histograms[v][i];
    }
    sums.put_all_out(put_out);
    bins.put_all_out(put_bins_out);
  });
}

std::vector<ClusterPlane> ClusterTable::planes() const {
  std::vector<ClusterPlane> planes(impl_->clusters.size());
  for (std::uint32_t c = 0; c < planes.size(); ++c) planes[c] = impl_->plane(c);
  return planes;
}

void ClusterTable::update_centres() {
  parallel_for_chunks(impl_->clusters.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) impl_->update(static_cast<std::uint32_t>(c));
  });
  impl_->sums.assign(impl_->clusters.size(), {});
  if (impl_->histograms) impl_->histogram_sums.assign(impl_->clusters.size(), {});
}

void ClusterTable::offer_seeds(const VoxelTile& tile, std::span<const std::uint32_t> clusters_of) {
  parallel_for_chunks(tile.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    ClusterSlots<SeedOffer> offers;
    const auto put_out = [&](std::uint32_t cluster, const SeedOffer& best) {
      const std::lock_guard guard(impl_->lock_of(cluster));
      if (best.better_than(impl_->offers[cluster])) impl_->offers[cluster] = best;
    };
    for (std::size_t v = begin; v < end; ++v) {
      const std::uint32_t cluster = clusters_of[v];
      if (tile.core[v] == 0 || cluster == kNoCluster) continue;
      SeedOffer offer{0, tile.ranks[v], tile.positions[v]};
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int64_t d = difference(tile.positions[v][i], impl_->clusters.centres[cluster].position[i]);
        offer.distance2 += static_cast<std::uint64_t>(d * d);
      }
      SeedOffer& best = offers.at(cluster, put_out);
      if (offer.better_than(best)) best = offer;
    }
    offers.put_all_out(put_out);
  });
}

void ClusterTable::move_seeds() {
  Clusters& c = impl_->clusters;
  for (std::uint32_t i = 0; i < c.size(); ++i) {
    c.seed_ranks[i] = impl_->offers[i].rank;
    c.seed_positions[i] = impl_->offers[i].position;
  }
  impl_->offers.assign(c.size(), {});
  impl_->order_by_rank();
}

}  // namespace arris::merge
