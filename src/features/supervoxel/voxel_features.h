#pragma once
/// @file What voxels are compared by.

#include <array>
#include <cstdint>

#include "core/pages.h"
#include "core/voxel_tile.h"
#include "features/supervoxel/point_feature_histogram.h"
#include "features/supervoxel/supervoxel_parameters.h"

namespace arris {

/// One entry per voxel of a tile; right for voxels whose feature rings are complete.
struct VoxelFeatures {
  PageVector<std::array<float, 3>> normals;
  PageVector<std::array<float, 3>> colours;  ///< RGB in 0..255 (kNormal) or CIELab (kFpfh); empty without colours.
  PageVector<FeatureHistogram> histograms;   ///< kFpfh only.
};

/// @param normals      voxel_normals() of the tile.
/// @param full_colour  raw channel value that stands for full intensity (255 or 65535).
VoxelFeatures voxel_features(const VoxelTile& tile, PageVector<std::array<float, 3>> normals,
                             const SupervoxelParameters& parameters, double full_colour);

/// Peak bytes per voxel of a tile while it is loaded, described and grown; for predictions.
/// @param neighbours  existing neighbours of a voxel on average, 0 to 26.
double supervoxel_bytes_per_voxel(SupervoxelParameters::Features features, bool colours, double neighbours);

}  // namespace arris
