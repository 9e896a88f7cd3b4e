#pragma once
/// @file The supervoxels of the whole scan between the passes over tiles: sums of members, new centres, new seeds.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "features/supervoxel/clusters.h"
#include "features/supervoxel/point_refinement.h"
#include "features/supervoxel/seed_cells.h"
#include "features/supervoxel/supervoxel_parameters.h"
#include "features/supervoxel/voxel_features.h"

namespace arris::merge {

/// One object for the whole run. Passes: add_seeds() per tile, fix_seeds(); then per iteration add_members() per tile
/// and update_centres(), and before the next one offer_seeds() per tile and move_seeds(). Sums are of integers and
/// minima are of (distance, rank), so neither tiles nor threads can change anything. The add and offer functions run in
/// parallel inside and may be called for one tile at a time.
///
/// Memory: about 200 bytes per supervoxel, 400 more with histograms.
class ClusterTable {
 public:
  explicit ClusterTable(const SupervoxelParameters& parameters);
  ~ClusterTable();

  /// Seeds of one tile; their centres begin with the features of their voxels.
  void add_seeds(const VoxelTile& tile, const VoxelFeatures& features, std::span<const Seed> seeds);
  /// Forgets all seeds; before fix_seeds() only.
  void drop_seeds();
  /// Gives the seeds their indices: ascending cells.
  void fix_seeds();

  const Clusters& clusters() const;
  /// Indices of the clusters in ascending order of the ranks of their seeds.
  std::span<const std::uint32_t> by_seed_rank() const;

  /// @param clusters_of  per voxel of the tile; only those of the core are counted.
  void add_members(const VoxelTile& tile, const VoxelFeatures& features, std::span<const std::uint32_t> clusters_of);
  /// Per cluster the plane of those members, of all added since the last update_centres(), whose normals are within 30
  /// degrees of the centre's: that of the surface that most of a supervoxel lies on. No plane where there are none.
  std::vector<ClusterPlane> planes() const;
  /// Centre: mean position (nearest fraction), mean normal (signs aligned with the old centre's), mean colour, mean
  /// histogram.
  void update_centres();

  /// Offers every core voxel as the next seed of its cluster: the one nearest to the centre wins, ties by rank.
  void offer_seeds(const VoxelTile& tile, std::span<const std::uint32_t> clusters_of);
  void move_seeds();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace arris::merge
