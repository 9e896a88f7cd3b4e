#include "features/candidate_set.h"

#include <algorithm>
#include <limits>

namespace arris {
namespace {

/// Largest coordinate magnitude that is exact in T. int64: any difference of lattice coordinates.
template <class T>
constexpr double kExactCoordinate = kExactSquares<T>;

/// A coordinate no reach comes to, with a finite square.
template <class T>
constexpr T kOutside = static_cast<T>(1e15);

}  // namespace

template <class T>
bool CandidateSet<T>::gather(const PointTree& tree, const ClosedBox& box, const GatherReach& wanted) {
  reach = wanted;
  near_count = 0;
  T low[3];
  T high[3];
  for (int axis = 0; axis < 3; ++axis) {
    origin[axis] = (std::int64_t{box.min[axis]} + box.max[axis]) >> 1;
    low[axis] = static_cast<T>(box.min[axis] - origin[axis]);
    high[axis] = static_cast<T>(box.max[axis] - origin[axis]);
  }
  // One step more than asked for, so that rounding of the test below cannot lose a point.
  const double near2_wide = (wanted.near + 1.0) * (wanted.near + 1.0);
  const double far2_wide = (wanted.far + 1.0) * (wanted.far + 1.0);
  const T near2 = static_cast<T>(near2_wide);
  const T far2 = static_cast<T>(far2_wide);
  std::size_t far_count = 0;
  bool exact = true;
  tree.visit_near(box, wanted.far + 1.0, [&](std::size_t begin, std::size_t end, const ClosedBox& bucket) {
    for (int axis = 0; axis < 3; ++axis) {
      const double below = static_cast<double>(origin[axis] - bucket.min[axis]);
      const double above = static_cast<double>(bucket.max[axis] - origin[axis]);
      if (std::max(below, above) > kExactCoordinate<T>) exact = false;
    }
    if (!exact) return;
    const std::size_t room = end - begin;
    if (x.size() < near_count + room + simd::kPadding) {
      const std::size_t size = std::max(2 * x.size(), near_count + room + simd::kPadding);
      x.resize(size);
      y.resize(size);
      z.resize(size);
      slot.resize(size);
    }
    if (far_rows_.size() < far_count + room) far_rows_.resize(std::max(2 * far_rows_.size(), far_count + room));
    for (std::size_t i = begin; i < end; ++i) {
      // Without branches: every point is written to both ends, and the ends advance as the point deserves.
      const T px = static_cast<T>(tree.x()[i] - origin[0]);
      const T py = static_cast<T>(tree.y()[i] - origin[1]);
      const T pz = static_cast<T>(tree.z()[i] - origin[2]);
      const T gx = bounded<T>(std::max(std::max(low[0] - px, px - high[0]), T{0}));
      const T gy = bounded<T>(std::max(std::max(low[1] - py, py - high[1]), T{0}));
      const T gz = bounded<T>(std::max(std::max(low[2] - pz, pz - high[2]), T{0}));
      const T d2 = gx * gx + gy * gy + gz * gz;
      const bool is_near = d2 <= near2;
      x[near_count] = px;
      y[near_count] = py;
      z[near_count] = pz;
      slot[near_count] = static_cast<std::uint32_t>(i);
      far_rows_[far_count] = {px, py, pz, static_cast<std::uint32_t>(i)};
      near_count += is_near;
      far_count += !is_near && d2 <= far2;
    }
  });
  if (!exact) return false;
  count = near_count + far_count;
  const std::size_t size = simd::padded(count);
  if (x.size() < size) {
    x.resize(size);
    y.resize(size);
    z.resize(size);
    slot.resize(size);
  }
  for (std::size_t i = 0; i < far_count; ++i) {
    x[near_count + i] = far_rows_[i].x;
    y[near_count + i] = far_rows_[i].y;
    z[near_count + i] = far_rows_[i].z;
    slot[near_count + i] = far_rows_[i].slot;
  }
  for (std::size_t i = count; i < size; ++i) {
    x[i] = y[i] = z[i] = kOutside<T>;
    slot[i] = std::numeric_limits<std::uint32_t>::max();
  }
  return true;
}

template struct CandidateSet<float>;
template struct CandidateSet<double>;
template struct CandidateSet<std::int64_t>;

}  // namespace arris
