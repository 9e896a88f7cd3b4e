#include "features/supervoxel/voxel_normals.h"

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

/// For each voxel the one, among choice(v) of itself and of its neighbours, whose window fits best; ties: the first.
/// What fits well is kept.
template <class Choice>
PageVector<std::uint32_t> better_windows(const VoxelTile& tile, const PageVector<WindowPlane>& planes,
                                         const Choice& choice) {
  const float per_side = per_voxel_side(tile);
  PageVector<std::uint32_t> best(tile.size());
  parallel_for_chunks(tile.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      best[v] = choice(static_cast<std::uint32_t>(v));
      float least = misfit(tile, planes, v, best[v], per_side);
      if (least <= kFlatMisfit) continue;
      for (const std::uint32_t u : tile.neighbours_of(v)) {
        const std::uint32_t window = choice(u);
        if (window == best[v]) continue;
        const float other = misfit(tile, planes, v, window, per_side);
        if (other < least) {
          least = other;
          best[v] = window;
        }
      }
    }
  });
  return best;
}

}  // namespace

PageVector<std::array<float, 3>> voxel_normals(const VoxelTile& tile) {
  const PageVector<WindowPlane> planes = window_planes(tile);
  PageVector<std::uint32_t> chosen = better_windows(tile, planes, [](std::uint32_t v) { return v; });
  for (int ring = 1; ring < kWindowRings; ++ring)
    chosen = better_windows(tile, planes, [&](std::uint32_t v) { return chosen[v]; });
  PageVector<std::array<float, 3>> normals(tile.size());
  parallel_for_chunks(tile.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) normals[v] = planes[chosen[v]].normal;
  });
  return normals;
}

}  // namespace arris
