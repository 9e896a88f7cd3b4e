#include "features/neighbourhood/nearest_distances.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "features/numerics/simd_compact.h"

namespace arris {
namespace {

/// Above this many, a comparison sort beats counting.
constexpr std::size_t kMostRanked = 160;

/// Squared distances up to `limit`. Writes up to simd::kPadding entries past them.
template <class T>
std::size_t collect_within(const CandidateSet<T>& c, const NearestQuery<T>& q, T limit, T* d2_out) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < c.count; ++i) {
    const T dx = bounded<T>(c.x[i] - q.x);
    const T dy = bounded<T>(c.y[i] - q.y);
    const T dz = bounded<T>(c.z[i] - q.z);
    d2_out[n] = dx * dx + dy * dy + dz * dz;
    n += d2_out[n] <= limit;
  }
  return n;
}

#if ARRIS_X86_KERNELS
ARRIS_TARGET_V4 std::size_t collect_avx512(const CandidateSet<float>& c, const NearestQuery<float>& q, float limit,
                                           float* d2_out) {
  const __m512 qx = _mm512_set1_ps(q.x);
  const __m512 qy = _mm512_set1_ps(q.y);
  const __m512 qz = _mm512_set1_ps(q.z);
  const __m512 most = _mm512_set1_ps(limit);
  std::size_t n = 0;
  for (std::size_t i = 0; i < simd::padded(c.count); i += 16) {  // The padding is beyond every limit.
    const __m512 dx = _mm512_sub_ps(_mm512_loadu_ps(c.x.data() + i), qx);
    const __m512 dy = _mm512_sub_ps(_mm512_loadu_ps(c.y.data() + i), qy);
    const __m512 dz = _mm512_sub_ps(_mm512_loadu_ps(c.z.data() + i), qz);
    const __m512 d2 = _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(dx, dx), _mm512_mul_ps(dy, dy)), _mm512_mul_ps(dz, dz));
    const __mmask16 in = _mm512_cmp_ps_mask(d2, most, _CMP_LE_OQ);
    _mm512_storeu_ps(d2_out + n, _mm512_maskz_compress_ps(in, d2));
    n += static_cast<std::size_t>(__builtin_popcount(in));
  }
  return n;
}

ARRIS_TARGET_V3 std::size_t collect_avx2(const CandidateSet<float>& c, const NearestQuery<float>& q, float limit,
                                         float* d2_out) {
  const __m256 qx = _mm256_set1_ps(q.x);
  const __m256 qy = _mm256_set1_ps(q.y);
  const __m256 qz = _mm256_set1_ps(q.z);
  const __m256 most = _mm256_set1_ps(limit);
  std::size_t n = 0;
  for (std::size_t i = 0; i < simd::padded(c.count); i += 8) {
    const __m256 dx = _mm256_sub_ps(_mm256_loadu_ps(c.x.data() + i), qx);
    const __m256 dy = _mm256_sub_ps(_mm256_loadu_ps(c.y.data() + i), qy);
    const __m256 dz = _mm256_sub_ps(_mm256_loadu_ps(c.z.data() + i), qz);
    const __m256 d2 = _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(dx, dx), _mm256_mul_ps(dy, dy)), _mm256_mul_ps(dz, dz));
    const int mask = _mm256_movemask_ps(_mm256_cmp_ps(d2, most, _CMP_LE_OQ));
    const __m256i order = _mm256_load_si256(reinterpret_cast<const __m256i*>(simd::kCompactTable.lanes[mask]));
    _mm256_storeu_ps(d2_out + n, _mm256_permutevar8x32_ps(d2, order));
    n += static_cast<std::size_t>(__builtin_popcount(static_cast<unsigned>(mask)));
  }
  return n;
}
#endif

template <class T>
std::size_t collect(const CandidateSet<T>& c, const NearestQuery<T>& q, T limit, T* d2) {
#if ARRIS_X86_KERNELS
  if constexpr (std::is_same_v<T, float>) {
    if (simd::widest_bytes() == 64) return collect_avx512(c, q, limit, d2);
    if (simd::widest_bytes() == 32) return collect_avx2(c, q, limit, d2);
  }
#endif
  return collect_within(c, q, limit, d2);
}

/// Sorts by counting, for each value, how many are smaller. Of equal values one gets its place; its free neighbours are
/// filled from it.
struct SortByRank {
  template <int Bytes, class T>
  static ARRIS_ALWAYS_INLINE void run(const T* values, std::size_t n, std::int32_t* rank, T* sorted) {
    using V = typename simd::VectorOf<T, Bytes>::Type;
    using Mask = typename simd::VectorOf<T, Bytes>::Mask;
    constexpr std::size_t kLanes = simd::VectorOf<T, Bytes>::kLanes;
    constexpr T kFree = -1;
    for (std::size_t block = 0; block < n; block += kLanes) {
      const V mine = simd::load<V>(values + block);
      Mask smaller{};
      for (std::size_t j = 0; j < n; ++j) smaller -= (mine > values[j]);
      for (std::size_t lane = 0; lane < kLanes; ++lane) rank[block + lane] = static_cast<std::int32_t>(smaller[lane]);
      simd::store(sorted + block, V{} + kFree);
    }
    for (std::size_t i = 0; i < n; ++i) sorted[rank[i]] = values[i];
    for (std::size_t i = 1; i < n; ++i) sorted[i] = sorted[i] == kFree ? sorted[i - 1] : sorted[i];
  }
};

}  // namespace

template <class T>
void select_nearest(const PointTree& /*tree*/, const CandidateSet<T>& candidates, const NearestQuery<T>& query,
                    NearestScratch<T>& scratch, NearestDistances& found) {
  const std::size_t room = simd::padded(candidates.count) + simd::kPadding;
  if (scratch.d2.size() < room) {
    scratch.d2.resize(room);
    scratch.rank.resize(room);
    scratch.sorted_d2.resize(room);
  }
  T limit = std::min(query.guess_d2, query.max_d2);
  std::size_t n = 0;
  for (;;) {
    n = collect(candidates, query, limit, scratch.d2.data());
    if (n > query.k || limit >= query.max_d2) break;
    // On a surface the number grows with the square of the distance; a little more, so that the next try is the last.
    const double growth = std::clamp(1.3 * static_cast<double>(query.k + 1) / static_cast<double>(n + 1), 1.5, 8.0);
    const double next = static_cast<double>(limit) * growth + 1.0;
    limit = next >= static_cast<double>(query.max_d2) ? query.max_d2 : static_cast<T>(next);
  }
  const std::size_t wanted = std::min(n, query.k + 1);  // With the query itself, which comes first.
  const T* sorted = scratch.d2.data();
  if (std::is_same_v<T, std::int64_t> || n > kMostRanked) {
    std::partial_sort(scratch.d2.begin(), scratch.d2.begin() + static_cast<std::ptrdiff_t>(wanted),
                      scratch.d2.begin() + static_cast<std::ptrdiff_t>(n));
  } else if constexpr (!std::is_same_v<T, std::int64_t>) {
    simd::dispatch<SortByRank>(sorted, n, scratch.rank.data(), scratch.sorted_d2.data());
    sorted = scratch.sorted_d2.data();
  }
  found.count = wanted - 1;
  for (std::size_t i = 0; i < found.count; ++i) found.d2[i] = static_cast<double>(sorted[i + 1]);
  for (std::size_t i = found.count; i < simd::padded(found.count); ++i) found.d2[i] = 0.0;
  found.last_d2 = found.count > 0 ? static_cast<std::uint64_t>(sorted[found.count]) : 0;
}

template void select_nearest(const PointTree&, const CandidateSet<float>&, const NearestQuery<float>&,
                             NearestScratch<float>&, NearestDistances&);
template void select_nearest(const PointTree&, const CandidateSet<double>&, const NearestQuery<double>&,
                             NearestScratch<double>&, NearestDistances&);
template void select_nearest(const PointTree&, const CandidateSet<std::int64_t>&, const NearestQuery<std::int64_t>&,
                             NearestScratch<std::int64_t>&, NearestDistances&);

}  // namespace arris
