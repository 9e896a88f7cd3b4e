#include "features/supervoxel/voxel_features.h"

#include <algorithm>
#include <utility>

#include "core/parallel.h"
#include "features/supervoxel/cie_lab.h"

namespace arris {

VoxelFeatures voxel_features(const VoxelTile& tile, PageVector<std::array<float, 3>> normals,
                             const SupervoxelParameters& parameters, double full_colour) {
  const bool fpfh = parameters.features == SupervoxelParameters::Features::kFpfh;
  VoxelFeatures features;
  features.normals = std::move(normals);
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

double supervoxel_bytes_per_voxel(SupervoxelParameters::Features features, bool colours, double neighbours) {
  const double kept =
      12.0 + 12.0 + 4.0 + 1.0 + 4.0 + (colours ? 6.0 : 0.0);  // Key, position, rank, core, first neighbour.
  const double linking = kept + 3.0 + 4.0 * neighbours;       // And the tile's own index.
  const double described = kept + 4.0 * neighbours + 12.0 + (colours ? 12.0 : 0.0);
  const double windows = described + 28.0;
  const double growing = described + 25.0;  // State, frontier, clusters.
  const double histograms = features == SupervoxelParameters::Features::kFpfh ? 80.0 : 0.0;
  const double counting = histograms > 0.0 ? described + histograms + 34.0 : 0.0;
  return std::max({linking, windows, growing + histograms, counting});
}

}  // namespace arris
