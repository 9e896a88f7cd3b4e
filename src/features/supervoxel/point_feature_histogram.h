#pragma once
/// @file Fast point feature histograms of voxels (Rusu et al. 2009): how surfaces bend around a voxel, in 33 numbers.

#include <array>
#include <cstdint>
#include <span>

#include "core/pages.h"
#include "core/voxel_tile.h"

namespace arris {

/// 3 histograms (alpha, phi, theta) of 11 bins, padded with zeros for vector code. All bins add up to about
/// kHistogramTotal (rounding), or are all 0 for a voxel without normal or neighbours.
using FeatureHistogram = std::array<std::int16_t, 40>;
constexpr int kHistogramBins = 33;
constexpr std::int32_t kHistogramTotal = 32766;

/// Darboux frame of a pair of points with unit normals: alpha = v . n2, phi = u . d / |d| in [-1, 1], theta in [-pi,
/// pi].
struct PairFeatures {
  float alpha, phi, theta;
};
/// @param d  from the first point to the second. As Rusu et al.: the point whose normal is closer to the line becomes
/// the source. False (no features) if the points coincide or the line is parallel to the source's normal.
bool pair_features(const std::array<float, 3>& d, const std::array<float, 3>& n1, const std::array<float, 3>& n2,
                   PairFeatures& out);

/// FPFH(v) = SPFH(v) + 1/k sum over the 26-neighbours u of SPFH(u) / |u - v|, normalised per histogram; distances in
/// voxel sides. Depends on the normals in two rings. Runs in parallel; 36 bytes per voxel while it works.
PageVector<FeatureHistogram> feature_histograms(const VoxelTile& tile, std::span<const std::array<float, 3>> normals);

/// Distance by histogram intersection: 1 - sum of minima / total, in [0, 1].
inline float intersection_distance(const FeatureHistogram& a, const FeatureHistogram& b) {
  std::int32_t common = 0;
  for (std::size_t i = 0; i < a.size(); ++i) common += a[i] < b[i] ? a[i] : b[i];
  const std::int32_t left = kHistogramTotal - common;
  return left <= 0 ? 0.0F : static_cast<float>(left) * (1.0F / static_cast<float>(kHistogramTotal));
}

}  // namespace arris
