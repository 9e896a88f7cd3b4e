#include "features/supervoxel/voxel_windows.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "features/supervoxel/least_direction.h"

namespace arris {
namespace {

/// So few that the moments of a chunk stay in the cache.
constexpr std::size_t kGrain = 4 * 1024;
/// A plane needs two directions: the second eigenvalue must be at least this share of the first.
constexpr double kLeastWidth = 1e-4;
/// A window of one ring takes the place of one of two only where its scatter is so much less: noise never makes it so.
constexpr float kNarrowPenalty = 4.0F;
/// (3, 4, 12) / 13: hardly any surface is perpendicular to it, so neighbours on a wall agree in sign.
constexpr std::array<double, 3> kGeneric{3.0 / 13.0, 4.0 / 13.0, 12.0 / 13.0};

/// Of offsets from a voxel's own centroid, in voxel sides. The voxel itself is in it.
struct Moments {
  float n = 1.0F;
  std::array<float, 3> sum{};
  std::array<float, 6> square{};  // xx xy xz yy yz zz
};

Moments ring_moments(const VoxelTile& tile, std::size_t v, float per_side) {
  Moments m;
  for (const std::uint32_t u : tile.neighbours_of(v)) {
    const auto [x, y, z] = centroid_offset(tile.positions[v], tile.positions[u], per_side);
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

/// Planes of several windows at once.
class PlaneBatch {
 public:
  explicit PlaneBatch(float penalty) : penalty_(penalty) {}

  /// @param to  gets the plane at the next flush().
  void add(const Moments& m, WindowPlane& to) {
    const double inverse = 1.0 / m.n;
    const double x = m.sum[0] * inverse;
    const double y = m.sum[1] * inverse;
    const double z = m.sum[2] * inverse;
    mean_[count_] = {x, y, z};
    fits_.set(count_, {m.square[0] * inverse - x * x, m.square[1] * inverse - x * y, m.square[2] * inverse - x * z,
                       m.square[3] * inverse - y * y, m.square[4] * inverse - y * z, m.square[5] * inverse - z * z});
    to_[count_] = &to;
    if (++count_ == LeastDirections::kCount) flush();
  }

  void flush() {
    if (count_ == 0) return;
    fits_.solve();
    for (std::size_t i = 0; i < count_; ++i) *to_[i] = plane(i);
    count_ = 0;
  }

 private:
  WindowPlane plane(std::size_t i) const {
    const Eigenvalues<double> values = fits_.values(i);
    WindowPlane plane = kNoPlane;
    if (!(values.middle > kLeastWidth * values.largest) || !(values.largest > 0.0)) return plane;
    Vector3 e = fits_.direction(i);
    if (e[0] * kGeneric[0] + e[1] * kGeneric[1] + e[2] * kGeneric[2] < 0.0) e = {-e[0], -e[1], -e[2]};
    plane.normal = {static_cast<float>(e[0]), static_cast<float>(e[1]), static_cast<float>(e[2])};
    plane.offset = static_cast<float>(e[0] * mean_[i][0] + e[1] * mean_[i][1] + e[2] * mean_[i][2]);
    plane.misfit = penalty_ * static_cast<float>(std::max(values.smallest, 0.0));
    return plane;
  }

  float penalty_;
  std::size_t count_ = 0;
  LeastDirections fits_;
  std::array<Vector3, LeastDirections::kCount> mean_;
  std::array<WindowPlane*, LeastDirections::kCount> to_;
};

}  // namespace

PageVector<WindowPlane> window_planes(const VoxelTile& tile) {
  const float per_side = per_voxel_side(tile);
  PageVector<WindowPlane> planes(tile.size());
  parallel_for_chunks(tile.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    // Moments of the chunk's own rings are kept; the few others that are needed are made again, which costs less than
    // memory for all.
    std::vector<Moments> own(end - begin);
    for (std::size_t v = begin; v < end; ++v) own[v - begin] = ring_moments(tile, v, per_side);
    PlaneBatch wide(1.0F);
    for (std::size_t v = begin; v < end; ++v) {
      Moments m = own[v - begin];
      for (const std::uint32_t u : tile.neighbours_of(v)) {
        const std::array<float, 3> shift = centroid_offset(tile.positions[v], tile.positions[u], per_side);
        if (u >= begin && u < end) {
          add_shifted(m, own[u - begin], shift);
        } else {
          add_shifted(m, ring_moments(tile, u, per_side), shift);
        }
      }
      wide.add(m, planes[v]);
    }
    wide.flush();
    std::vector<std::uint32_t> uneven;
    for (std::size_t v = begin; v < end; ++v) {
      if (planes[v].misfit > kFlatMisfit) uneven.push_back(static_cast<std::uint32_t>(v));
    }
    std::vector<WindowPlane> narrow(uneven.size());
    PlaneBatch one_ring(kNarrowPenalty);
    for (std::size_t i = 0; i < uneven.size(); ++i) one_ring.add(own[uneven[i] - begin], narrow[i]);
    one_ring.flush();
    for (std::size_t i = 0; i < uneven.size(); ++i) {
      if (narrow[i].misfit < planes[uneven[i]].misfit) planes[uneven[i]] = narrow[i];
    }
  });
  return planes;
}

}  // namespace arris
