#pragma once
/// @file The supervoxels of a scan while they grow.

#include <array>
#include <cstdint>
#include <vector>

#include "core/voxel_tile.h"
#include "features/supervoxel/point_feature_histogram.h"

namespace arris {

/// What voxels are compared with.
struct ClusterCentre {
  VoxelPosition position{};
  std::array<float, 3> normal{};  ///< (0, 0, 0) if undefined.
  std::array<float, 3> colour{};
};

/// All clusters of the scan, by index; seeds that lose every voxel do not exist (a seed's own voxel stays with it).
/// Small beside the voxels: 64 bytes a cluster, 80 more with histograms. Fixed while an iteration runs.
struct Clusters {
  std::vector<std::uint32_t> seed_ranks;      ///< Rank of the voxel that a cluster grows from.
  std::vector<VoxelPosition> seed_positions;  ///< Its centroid.
  std::vector<ClusterCentre> centres;
  std::vector<FeatureHistogram> histograms;  ///< Of the centres; kFpfh only.

  std::uint32_t size() const { return static_cast<std::uint32_t>(seed_ranks.size()); }
};

/// No cluster.
constexpr std::uint32_t kNoCluster = 0xffffffffU;

}  // namespace arris
