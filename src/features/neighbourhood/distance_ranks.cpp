#include "features/neighbourhood/distance_ranks.h"

#include <limits>
#include <type_traits>

#include "features/neighbourhood/candidate_set.h"
#include "features/numerics/simd.h"

namespace arris {
namespace {

/// A key may be a squared distance followed by the place in the list, so that no two are equal.
constexpr int kPlaceBits = 7;
static_assert(kMostRanked == std::size_t{1} << kPlaceBits);
static_assert(kExactSquares<float> * kMostRanked <= 2147483648.0 && kExactSquares<double> * kMostRanked <= 9.2e18);

/// rank[i] = how many of the n values are smaller than values[i]; with kPlaces those too that are equal and further in
/// front. Sums up those ranks.
template <bool kPlaces>
struct CountSmaller {
  template <int Bytes, class T>
  static ARRIS_ALWAYS_INLINE void run(const T* values, std::size_t n, std::int32_t* rank, std::int64_t& sum) {
    using V = typename simd::VectorOf<T, Bytes>::Type;
    using Keys = typename simd::VectorOf<T, Bytes>::Mask;
    using Key = std::conditional_t<std::is_same_v<T, float>, std::int32_t, std::int64_t>;
    constexpr std::size_t kLanes = simd::VectorOf<T, Bytes>::kLanes;
    alignas(64) Key keys[kMostRanked];
    Keys place, sums{};
    for (std::size_t lane = 0; lane < kLanes; ++lane) place[lane] = static_cast<Key>(lane);
    for (std::size_t block = 0; block < n; block += kLanes) {
      Keys own = __builtin_convertvector(simd::load<V>(values + block), Keys);
      if constexpr (kPlaces) own = (own << kPlaceBits) + place;
      // What fills the last vector is greater than all others: its ranks are n.
      simd::store(keys + block, place < static_cast<Key>(n) ? own : Keys{} + std::numeric_limits<Key>::max());
      place += static_cast<Key>(kLanes);
    }
    for (std::size_t begin = 0; begin < n;) {
      // Several vectors at a time: they share what each key is read for.
      const std::size_t vectors = (n - begin + kLanes - 1) / kLanes;
      if (vectors >= 4) {
        sums += count<4, Keys>(keys, n, begin, rank);
        begin += 4 * kLanes;
      } else if (vectors == 3) {
        sums += count<3, Keys>(keys, n, begin, rank);
        begin += 3 * kLanes;
      } else {
        sums += count<1, Keys>(keys, n, begin, rank);
        begin += kLanes;
      }
    }
    const std::size_t fill = (n + kLanes - 1) / kLanes * kLanes - n;
    sum = -static_cast<std::int64_t>(fill * n);
    for (std::size_t lane = 0; lane < kLanes; ++lane) sum += sums[lane];
  }

 private:
  /// Ranks of kVectors vectors of keys; returns their sum.
  template <std::size_t kVectors, class Keys, class Key>
  static ARRIS_ALWAYS_INLINE Keys count(const Key* keys, std::size_t n, std::size_t begin, std::int32_t* rank) {
    constexpr std::size_t kLanes = sizeof(Keys) / sizeof(Key);
    Keys mine[kVectors], smaller[kVectors];
    ARRIS_UNROLL
    for (std::size_t v = 0; v < kVectors; ++v) {
      mine[v] = simd::load<Keys>(keys + begin + v * kLanes);
      smaller[v] = Keys{};
    }
    for (std::size_t j = 0; j < n; ++j) {
      ARRIS_UNROLL
      for (std::size_t v = 0; v < kVectors; ++v) smaller[v] = mine[v] > keys[j] ? smaller[v] + 1 : smaller[v];
    }
    Keys sum{};
    ARRIS_UNROLL
    for (std::size_t v = 0; v < kVectors; ++v) {
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        rank[begin + v * kLanes + lane] = static_cast<std::int32_t>(smaller[v][lane]);
      sum += smaller[v];
    }
    return sum;
  }
};

}  // namespace

template <class T>
bool rank_distances(const T* values, std::size_t n, std::int32_t* rank) {
  std::int64_t sum = 0;
  simd::dispatch<CountSmaller<false>>(values, n, rank, sum);
  // No two ranks are equal only if their sum is that of 0 to n - 1.
  if (sum == static_cast<std::int64_t>(n * (n - 1) / 2)) return false;
  simd::dispatch<CountSmaller<true>>(values, n, rank, sum);
  return true;
}

template bool rank_distances(const float*, std::size_t, std::int32_t*);
template bool rank_distances(const double*, std::size_t, std::int32_t*);

}  // namespace arris
