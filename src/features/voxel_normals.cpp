#include "features/voxel_normals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/parallel.h"
#include "features/symmetric_eigen3.h"

namespace arris {
namespace {

constexpr std::size_t kGrain = 16 * 1024;
/// A plane needs two directions: the second eigenvalue must be at least this share of the first.
constexpr double kLeastWidth = 1e-4;
/// A window of one ring takes the place of one of two where its scatter is so much less: on steps and bars that are hardly
/// wider. Noise alone never makes it so. Not tried where two rings are flat (squares of voxel sides).
constexpr float kNarrowPenalty = 4.0F;
constexpr float kFlatVariance = 0.001F;
/// A window that stays on one side of a fold has its middle this many voxels away.
constexpr int kWindowRings = 2;
/// Normals have a positive component along this (3, 4, 12) / 13, so that neighbours on a wall agree.
constexpr std::array<double, 3> kGeneric{3.0 / 13.0, 4.0 / 13.0, 12.0 / 13.0};

/// Of offsets from a voxel's own centroid, in voxel sides.
struct Moments {
  float n = 1.0F;
  std::array<float, 3> sum{};
  std::array<float, 6> square{};  // xx xy xz yy yz zz
};

std::array<float, 3> offset(const VoxelPosition& from, const VoxelPosition& to, float per_side) {
  return {static_cast<float>(difference(to[0], from[0])) * per_side,
          static_cast<float>(difference(to[1], from[1])) * per_side,
          static_cast<float>(difference(to[2], from[2])) * per_side};
}

Moments ring_moments(const VoxelTile& tile, std::size_t v, float per_side) {
  Moments m;
  for (const std::uint32_t u : tile.neighbours_of(v)) {
    const auto [x, y, z] = offset(tile.positions[v], tile.positions[u], per_side);
    m.n += 1.0F;
    m.sum[0] += x;
    m.sum[1] += y;
    m.sum[2] += z;
    m.square[0] += x * x;
    m.square[1] += x * y;
    m.square[2] += x * z;
    m.square[3] += y * y;
    m.square[4] += y * z;
    m.square[5] += z * z;
  }
  return m;
}

/// Adds the moments of another voxel, whose centroid lies at (x, y, z) from this one's.
void add_shifted(Moments& to, const Moments& m, const std::array<float, 3>& shift) {
  const auto [x, y, z] = shift;
  const auto [sx, sy, sz] = m.sum;
  to.n += m.n;
  to.sum[0] += sx + m.n * x;
  to.sum[1] += sy + m.n * y;
  to.sum[2] += sz + m.n * z;
  to.square[0] += m.square[0] + 2.0F * sx * x + m.n * x * x;
  to.square[1] += m.square[1] + sx * y + sy * x + m.n * x * y;
  to.square[2] += m.square[2] + sx * z + sz * x + m.n * x * z;
  to.square[3] += m.square[3] + 2.0F * sy * y + m.n * y * y;
  to.square[4] += m.square[4] + sy * z + sz * y + m.n * y * z;
  to.square[5] += m.square[5] + 2.0F * sz * z + m.n * z * z;
}

/// The plane of a window, as seen from its middle voxel, in voxel sides.
struct WindowPlane {
  std::array<float, 3> normal{};                            ///< (0, 0, 0): none.
  std::array<float, 3> mean{};                              ///< From the middle voxel's centroid.
  float variance = std::numeric_limits<float>::infinity();  ///< Mean squared distance from the plane.
};

WindowPlane plane_of(const Moments& m) {
  const double n = m.n;
  const double x = m.sum[0] / n;
  const double y = m.sum[1] / n;
  const double z = m.sum[2] / n;
  const SymmetricMatrix<double> covariance{m.square[0] / n - x * x, m.square[1] / n - x * y, m.square[2] / n - x * z,
                                           m.square[3] / n - y * y, m.square[4] / n - y * z, m.square[5] / n - z * z};
  const Eigenvalues<double> values = eigenvalues_of(covariance);
  WindowPlane plane;
  if (!(values.middle > kLeastWidth * values.largest) || !(values.largest > 0.0)) return plane;
  Vector3 e = principal_frame(covariance, values).e3;
  if (e[0] * kGeneric[0] + e[1] * kGeneric[1] + e[2] * kGeneric[2] < 0.0) e = {-e[0], -e[1], -e[2]};
  plane.normal = {static_cast<float>(e[0]), static_cast<float>(e[1]), static_cast<float>(e[2])};
  plane.mean = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
  plane.variance = static_cast<float>(std::max(values.smallest, 0.0));
  return plane;
}

/// How badly the plane of window `u` fits voxel v: the window's own scatter and v's distance from it.
float misfit(const VoxelTile& tile, const std::vector<WindowPlane>& planes, std::size_t v, std::size_t u,
             float per_side) {
  const WindowPlane& plane = planes[u];
  const std::array<float, 3> off = offset(tile.positions[u], tile.positions[v], per_side);
  float distance = 0.0F;
  for (std::size_t i = 0; i < 3; ++i) distance += (off[i] - plane.mean[i]) * plane.normal[i];
  return plane.variance + distance * distance;
}

/// For each voxel the one, among `choice` of itself and of its neighbours, whose window fits best; ties: the first.
std::vector<std::uint32_t> better_windows(const VoxelTile& tile, const std::vector<WindowPlane>& planes,
                                          const std::vector<std::uint32_t>& choice, float per_side) {
  std::vector<std::uint32_t> best(tile.size());
  parallel_for_chunks(tile.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      best[v] = choice[v];
      float least = misfit(tile, planes, v, choice[v], per_side);
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

std::vector<std::array<float, 3>> voxel_normals(const VoxelTile& tile) {
  const float per_side = 1.0F / (static_cast<float>(kVoxelFractions) * static_cast<float>(tile.grid.side_steps()));
  std::vector<Moments> ring(tile.size());
  parallel_for_chunks(tile.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) ring[v] = ring_moments(tile, v, per_side);
  });
  std::vector<WindowPlane> planes(tile.size());
  parallel_for_chunks(tile.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      Moments m = ring[v];
      for (const std::uint32_t u : tile.neighbours_of(v))
        add_shifted(m, ring[u], offset(tile.positions[v], tile.positions[u], per_side));
      planes[v] = plane_of(m);
      if (planes[v].variance <= kFlatVariance) continue;
      WindowPlane narrow = plane_of(ring[v]);
      narrow.variance *= kNarrowPenalty;
      if (narrow.variance < planes[v].variance) planes[v] = narrow;
    }
  });
  ring = {};
  std::vector<std::uint32_t> choice(tile.size());
  std::iota(choice.begin(), choice.end(), 0U);
  for (int ring_of_windows = 0; ring_of_windows < kWindowRings; ++ring_of_windows)
    choice = better_windows(tile, planes, choice, per_side);
  std::vector<std::array<float, 3>> normals(tile.size());
  for (std::size_t v = 0; v < tile.size(); ++v) normals[v] = planes[choice[v]].normal;
  return normals;
}

}  // namespace arris
