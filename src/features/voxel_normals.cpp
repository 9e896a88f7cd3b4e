#include "features/voxel_normals.h"

#include <cmath>

#include "core/parallel.h"
#include "features/symmetric_eigen3.h"

namespace arris {
namespace {

constexpr std::size_t kGrain = 16 * 1024;
/// A plane needs two directions: the second eigenvalue must be at least this share of the first.
constexpr double kLeastWidth = 1e-4;
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

std::array<float, 3> normal_of(const Moments& m) {
  const double n = m.n;
  const double x = m.sum[0] / n;
  const double y = m.sum[1] / n;
  const double z = m.sum[2] / n;
  const SymmetricMatrix<double> covariance{m.square[0] / n - x * x, m.square[1] / n - x * y, m.square[2] / n - x * z,
                                           m.square[3] / n - y * y, m.square[4] / n - y * z, m.square[5] / n - z * z};
  const Eigenvalues<double> values = eigenvalues_of(covariance);
  if (!(values.middle > kLeastWidth * values.largest) || !(values.largest > 0.0)) return {0.0F, 0.0F, 0.0F};
  Vector3 e = principal_frame(covariance, values).e3;
  if (e[0] * kGeneric[0] + e[1] * kGeneric[1] + e[2] * kGeneric[2] < 0.0) e = {-e[0], -e[1], -e[2]};
  return {static_cast<float>(e[0]), static_cast<float>(e[1]), static_cast<float>(e[2])};
}

}  // namespace

std::vector<std::array<float, 3>> voxel_normals(const VoxelTile& tile) {
  const float per_side = 1.0F / (static_cast<float>(kVoxelFractions) * static_cast<float>(tile.grid.side_steps()));
  std::vector<Moments> ring(tile.size());
  parallel_for_chunks(tile.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) ring[v] = ring_moments(tile, v, per_side);
  });
  std::vector<std::array<float, 3>> normals(tile.size());
  parallel_for_chunks(tile.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      Moments m = ring[v];
      for (const std::uint32_t u : tile.neighbours_of(v))
        add_shifted(m, ring[u], offset(tile.positions[v], tile.positions[u], per_side));
      normals[v] = normal_of(m);
    }
  });
  return normals;
}

}  // namespace arris
