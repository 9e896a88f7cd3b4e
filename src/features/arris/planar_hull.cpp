#include "features/arris/planar_hull.h"

#include <algorithm>
#include <limits>

#include "features/numerics/simd.h"

namespace arris {
namespace {

/// Above this many, a comparison sort beats counting.
constexpr std::size_t kMostRanked = 512;

/// ranks[i] = how many of the n keys are smaller than keys[i]. `keys` is padded to full vectors.
struct CountSmaller {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const float* keys, std::size_t n, std::int32_t* ranks) {
    using V = typename simd::Wide<Bytes>::Float;
    using Mask = typename simd::Wide<Bytes>::Int;
    for (std::size_t block = 0; block < n; block += Bytes / sizeof(float)) {
      const V mine = simd::load<V>(keys + block);
      Mask smaller{};
      for (std::size_t j = 0; j < n; ++j) smaller -= (mine > keys[j]);
      simd::store(ranks + block, smaller);
    }
  }
};

/// Sorts by x, rounded to float, and then what is left of the order: next to nothing.
void sort_by_rank(std::vector<Planar>& points, HullScratch& s) {
  const std::size_t n = points.size();
  s.keys.assign(simd::padded(n), std::numeric_limits<float>::max());
  s.ranks.resize(simd::padded(n));
  for (std::size_t i = 0; i < n; ++i) s.keys[i] = static_cast<float>(points[i].first);
  simd::dispatch<CountSmaller>(static_cast<const float*>(s.keys.data()), n, s.ranks.data());
  constexpr double kFree = std::numeric_limits<double>::infinity();
  s.sorted.assign(n, {kFree, kFree});
  for (std::size_t i = 0; i < n; ++i) {
    auto place = static_cast<std::size_t>(s.ranks[i]);
    while (s.sorted[place].first != kFree) ++place;  // Equal keys have equal ranks, and as many places from there on.
    s.sorted[place] = points[i];
  }
  points.swap(s.sorted);
  for (std::size_t i = 1; i < n; ++i) {
    const Planar point = points[i];
    std::size_t place = i;
    for (; place > 0 && point < points[place - 1]; --place) points[place] = points[place - 1];
    points[place] = point;
  }
}

double turn(const Planar& o, const Planar& a, const Planar& b) {
  return (a.first - o.first) * (b.second - o.second) - (a.second - o.second) * (b.first - o.first);
}

}  // namespace

void sort_planar(std::vector<Planar>& points, HullScratch& scratch) {
  if (points.size() > kMostRanked) {
    std::sort(points.begin(), points.end());
  } else {
    sort_by_rank(points, scratch);
  }
}

void keep_hull(std::vector<Planar>& points, HullScratch& scratch) {
  drop_inner_points(points, scratch.inner);
  sort_planar(points, scratch);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return;
  std::vector<Planar>& hull = scratch.hull;
  hull.clear();
  const auto extend = [&hull](const Planar& p, std::size_t floor) {
    while (hull.size() >= floor + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0.0) hull.pop_back();
    hull.push_back(p);
  };
  for (const Planar& p : points) extend(p, 0);
  const std::size_t upper = hull.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) extend(points[i], upper);
  hull.pop_back();
  points.swap(hull);
}

}  // namespace arris
