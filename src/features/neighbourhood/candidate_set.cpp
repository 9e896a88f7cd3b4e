#include "features/neighbourhood/candidate_set.h"

#include <limits>

#include "features/neighbourhood/candidate_window.h"

namespace arris {
namespace {

/// A coordinate no reach comes to, with a finite square.
template <class T>
constexpr T kOutside = static_cast<T>(1e15);

}  // namespace

template <class T>
void CandidateSet<T>::make_room(std::size_t size) {
  if (x.size() >= size) return;
  size = std::max(2 * x.size(), size);
  x.resize(size);
  y.resize(size);
  z.resize(size);
  slot.resize(size);
}

/// True if no box of a bucket is too far from the origin for T.
template <class T>
bool CandidateSet<T>::is_exact_in(const PointTree& tree) const {
  return std::all_of(buckets_.begin(), buckets_.end(), [&](std::uint32_t bucket) {
    const OuterBox box = tree.bucket_box(bucket);
    for (int axis = 0; axis < 3; ++axis) {
      const auto from = static_cast<double>(origin[axis]);
      if (std::max(from - box.min[axis], box.max[axis] - from) > kExactSquares<T>) return false;
    }
    return true;
  });
}

template <class T>
bool CandidateSet<T>::gather(const PointTree& tree, const ClosedBox& box, double reach) {
  Window<T> window;
  for (int axis = 0; axis < 3; ++axis) {
    origin[axis] = window.origin[axis] = (std::int64_t{box.min[axis]} + box.max[axis]) >> 1;
    window.low[axis] = static_cast<T>(box.min[axis] - origin[axis]);
    window.high[axis] = static_cast<T>(box.max[axis] - origin[axis]);
  }
  window.reach2 = static_cast<T>((reach + 1.0) * (reach + 1.0));
  farthest = 0.0;
  for (const T& high : window.high) farthest = std::max(farthest, static_cast<double>(high) + reach + 2.0);
  products.exact = false;
  buckets_.clear();
  tree.buckets_near(box, reach + 1.0, buckets_);
  // Boxes end near the window; how near is looked at only if they may be long.
  if (farthest + tree.longest_bucket() > kExactSquares<T> && !is_exact_in(tree)) return false;
  std::size_t n = 0;
  for (const std::uint32_t bucket : buckets_) {
    const std::size_t begin = tree.bucket_begin(bucket), end = tree.bucket_begin(bucket + 1);
    make_room(n + (end - begin) + simd::kPadding);
    n = append_near(tree, begin, end, window, *this, n);
  }
  count = n;
  const std::size_t size = simd::padded(n);
  make_room(size);
  for (std::size_t i = n; i < size; ++i) x[i] = y[i] = z[i] = kOutside<T>;
  return true;
}

template <class T>
void CandidateSet<T>::multiply() {
  if constexpr (std::is_same_v<T, float>) products.make(x, y, z, count, farthest);
}

template <class T>
void CandidateSet<T>::pack() {
  if constexpr (std::is_same_v<T, float>) {
    if (packed.size() < count) packed.resize(x.size());
    for (std::size_t i = 0; i < count; ++i) packed[i] = {x[i], y[i], z[i], slot[i]};
  }
}

template struct CandidateSet<float>;
template struct CandidateSet<double>;
template struct CandidateSet<std::int64_t>;

}  // namespace arris
