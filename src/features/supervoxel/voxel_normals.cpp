#include "features/supervoxel/voxel_normals.h"

#include <numeric>

#include "core/parallel.h"
#include "features/supervoxel/voxel_windows.h"

namespace arris {
namespace {

constexpr std::size_t kGrain = 16 * 1024;
/// A window that stays on one side of a fold has its middle this many voxels away.
constexpr int kWindowRings = 2;

/// How badly the plane of window `u` fits voxel v: the window's own scatter and v's squared distance from it.
float misfit(const VoxelTile& tile, const PageVector<WindowPlane>& planes, std::size_t v, std::size_t u,
             float per_side) {
  const WindowPlane& plane = planes[u];
  const std::array<float, 3> off = centroid_offset(tile.positions[u], tile.positions[v], per_side);
  const float distance = off[0] * plane.normal[0] + off[1] * plane.normal[1] + off[2] * plane.normal[2] - plane.offset;
  return plane.misfit + distance * distance;
}

/// For each voxel the one, among `choice` of itself and of its neighbours, whose window fits best; ties: the first.
/// What fits well is kept.
PageVector<std::uint32_t> better_windows(const VoxelTile& tile, const PageVector<WindowPlane>& planes,
                                         const PageVector<std::uint32_t>& choice) {
  const float per_side = per_voxel_side(tile);
  PageVector<std::uint32_t> best(tile.size());
  parallel_for_chunks(tile.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      best[v] = choice[v];
      float least = misfit(tile, planes, v, choice[v], per_side);
      if (least <= kFlatMisfit) continue;
      for (const std::uint32_t u : tile.neighbours_of(v)) {
        if (choice[u] == best[v]) continue;
        const float other = misfit(tile, planes, v, choice[u], per_side);
        if (other < least) {
          least = other;
          best[v] = choice[u];
        }
      }
    }
  });
  return best;
}

}  // namespace

PageVector<std::array<float, 3>> voxel_normals(const VoxelTile& tile) {
  const PageVector<WindowPlane> planes = window_planes(tile);
  PageVector<std::uint32_t> choice(tile.size());
  std::iota(choice.begin(), choice.end(), 0U);
  for (int ring = 0; ring < kWindowRings; ++ring) choice = better_windows(tile, planes, choice);
  PageVector<std::array<float, 3>> normals(tile.size());
  for (std::size_t v = 0; v < tile.size(); ++v) normals[v] = planes[choice[v]].normal;
  return normals;
}

}  // namespace arris
