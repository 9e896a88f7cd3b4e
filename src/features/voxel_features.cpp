#include "features/voxel_features.h"

#include "core/parallel.h"
#include "features/cie_lab.h"
#include "features/voxel_normals.h"

namespace arris {

VoxelFeatures voxel_features(const VoxelTile& tile, const SupervoxelParameters& parameters, double full_colour) {
  const bool fpfh = parameters.features == SupervoxelParameters::Features::kFpfh;
  VoxelFeatures features;
  features.normals = voxel_normals(tile);
  if (fpfh) features.histograms = feature_histograms(tile, features.normals);
  features.colours.resize(tile.colours.size());
  parallel_for_chunks(tile.colours.size(), 16 * 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const RawColour& raw = tile.colours[v];
      if (fpfh) {
        features.colours[v] = cie_lab({raw[0] / full_colour, raw[1] / full_colour, raw[2] / full_colour});
      } else {
        for (std::size_t c = 0; c < 3; ++c) features.colours[v][c] = static_cast<float>(255.0 * raw[c] / full_colour);
      }
    }
  });
  return features;
}

double supervoxel_bytes_per_voxel(SupervoxelParameters::Features features, bool colours) {
  // Voxel as read, key, position, rank, core, adjacency (up to 15 neighbours on rough surfaces), normal with its
  // moments or growth state and frontiers, the tile's own index.
  double bytes = 36.0 + 12.0 + 12.0 + 4.0 + 1.0 + 68.0 + 12.0 + 40.0 + 3.0;
  if (colours) bytes += 6.0 + 12.0;
  if (features == SupervoxelParameters::Features::kFpfh) bytes += 80.0 + 36.0;
  return bytes;
}

}  // namespace arris
