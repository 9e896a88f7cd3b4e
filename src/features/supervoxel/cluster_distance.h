#pragma once
/// @file The distance of a voxel to a cluster's centre, in both readings.

#include <cmath>

#include "core/prefetch.h"
#include "features/supervoxel/clusters.h"
#include "features/supervoxel/supervoxel_parameters.h"
#include "features/supervoxel/voxel_features.h"

namespace arris {

/// Shared by both: references must outlive it.
struct ClusterDistanceData {
  const VoxelTile& tile;
  const VoxelFeatures& features;
  const Clusters& clusters;
};

inline float squared_offset(const VoxelPosition& a, const VoxelPosition& b) {
  float sum = 0.0F;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto d = static_cast<float>(difference(a[axis], b[axis]));
    sum += d * d;
  }
  return sum;
}

inline float squared_colour_offset(const ClusterDistanceData& d, std::uint32_t voxel, std::uint32_t cluster) {
  if (d.features.colours.empty()) return 0.0F;
  float sum = 0.0F;
  for (std::size_t c = 0; c < 3; ++c) {
    const float off = d.features.colours[voxel][c] - d.clusters.centres[cluster].colour[c];
    sum += off * off;
  }
  return sum;
}

/// w_n (1 - |n . n'|) + w_s |dx| / R_seed + w_c |dRGB| / 255. Undefined normals count as perpendicular to all.
class NormalDistance {
 public:
  NormalDistance(const ClusterDistanceData& data, const SupervoxelParameters& p, const SupervoxelScale& scale)
      : data_(data),
        normal_(static_cast<float>(p.normal_weight)),
        spatial_(static_cast<float>(p.spatial_weight /
                                    (static_cast<double>(kVoxelFractions) * static_cast<double>(scale.seed_steps)))),
        colour_(static_cast<float>(p.colour_weight / 255.0)) {}

  float operator()(std::uint32_t voxel, std::uint32_t cluster) const {
    const ClusterCentre& centre = data_.clusters.centres[cluster];
    const std::array<float, 3>& n = data_.features.normals[voxel];
    const float cosine = std::abs(n[0] * centre.normal[0] + n[1] * centre.normal[1] + n[2] * centre.normal[2]);
    const float bend = cosine < 1.0F ? 1.0F - cosine : 0.0F;
    return normal_ * bend + spatial_ * std::sqrt(squared_offset(data_.tile.positions[voxel], centre.position)) +
           colour_ * std::sqrt(squared_colour_offset(data_, voxel, cluster));
  }
  /// What a distance of the voxel reads; colours seldom take part.
  void prefetch(std::uint32_t voxel) const {
    arris::prefetch(&data_.features.normals[voxel]);
    arris::prefetch(&data_.tile.positions[voxel]);
  }

 private:
  ClusterDistanceData data_;
  float normal_, spatial_, colour_;
};

/// Eq. (2): sqrt(lambda Dc^2 / m^2 + mu Ds^2 / (3 R_seed^2) + epsilon D_HIK^2).
class HistogramDistance {
 public:
  HistogramDistance(const ClusterDistanceData& data, const SupervoxelParameters& p, const SupervoxelScale& scale)
      : data_(data), epsilon_(static_cast<float>(p.epsilon)) {
    const double seed = static_cast<double>(kVoxelFractions) * static_cast<double>(scale.seed_steps);
    spatial_ = static_cast<float>(p.mu / (3.0 * seed * seed));
    colour_ = static_cast<float>(p.lambda / (p.colour_scale * p.colour_scale));
  }

  float operator()(std::uint32_t voxel, std::uint32_t cluster) const {
    const float shape = intersection_distance(data_.features.histograms[voxel], data_.clusters.histograms[cluster]);
    const float space = squared_offset(data_.tile.positions[voxel], data_.clusters.centres[cluster].position);
    return std::sqrt(colour_ * squared_colour_offset(data_, voxel, cluster) + spatial_ * space +
                     epsilon_ * shape * shape);
  }
  void prefetch(std::uint32_t voxel) const {
    arris::prefetch(&data_.features.histograms[voxel]);
    arris::prefetch(&data_.tile.positions[voxel]);
  }

 private:
  ClusterDistanceData data_;
  float epsilon_, spatial_ = 0.0F, colour_ = 0.0F;
};

}  // namespace arris
