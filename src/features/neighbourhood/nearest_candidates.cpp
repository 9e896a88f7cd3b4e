#include "features/neighbourhood/nearest_candidates.h"

#include <algorithm>
#include <type_traits>

#include "features/numerics/simd_compact.h"

namespace arris {
namespace {

template <bool kIndices, class T>
std::size_t collect_within(const CandidateSet<T>& c, const NearestQuery<T>& q, T limit, T* d2_out,
                           std::uint32_t* candidate_out) {
  constexpr std::size_t kBlock =
      64;  // Distances of a block first: that loop has no dependences and becomes vector code.
  T d2[kBlock];
  std::size_t n = 0;
  for (std::size_t begin = 0; begin < c.count; begin += kBlock) {
    const std::size_t length = std::min(kBlock, c.count - begin);
    for (std::size_t i = 0; i < length; ++i) {
      const T dx = bounded<T>(c.x[begin + i] - q.x);
      const T dy = bounded<T>(c.y[begin + i] - q.y);
      const T dz = bounded<T>(c.z[begin + i] - q.z);
      d2[i] = dx * dx + dy * dy + dz * dz;
    }
    for (std::size_t i = 0; i < length; ++i) {
      d2_out[n] = d2[i];
      if constexpr (kIndices) candidate_out[n] = static_cast<std::uint32_t>(begin + i);
      n += d2[i] <= limit;
    }
  }
  return n;
}

#if ARRIS_X86_KERNELS
template <bool kIndices>
ARRIS_TARGET_V4 std::size_t collect_avx512(const CandidateSet<float>& c, const NearestQuery<float>& q, float limit,
                                           float* d2_out, std::uint32_t* candidate_out) {
  const __m512 qx = _mm512_set1_ps(q.x);
  const __m512 qy = _mm512_set1_ps(q.y);
  const __m512 qz = _mm512_set1_ps(q.z);
  const __m512 most = _mm512_set1_ps(limit);
  __m512i index = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  std::size_t n = 0;
  for (std::size_t i = 0; i < simd::padded(c.count); i += 16) {  // The padding is beyond every limit.
    const __m512 dx = _mm512_sub_ps(_mm512_loadu_ps(c.x.data() + i), qx);
    const __m512 dy = _mm512_sub_ps(_mm512_loadu_ps(c.y.data() + i), qy);
    const __m512 dz = _mm512_sub_ps(_mm512_loadu_ps(c.z.data() + i), qz);
    const __m512 d2 = _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(dx, dx), _mm512_mul_ps(dy, dy)), _mm512_mul_ps(dz, dz));
    const __mmask16 in = _mm512_cmp_ps_mask(d2, most, _CMP_LE_OQ);
    _mm512_storeu_ps(d2_out + n, _mm512_maskz_compress_ps(in, d2));
    if constexpr (kIndices) _mm512_storeu_si512(candidate_out + n, _mm512_maskz_compress_epi32(in, index));
    n += static_cast<std::size_t>(__builtin_popcount(in));
    index = _mm512_add_epi32(index, _mm512_set1_epi32(16));
  }
  return n;
}

template <bool kIndices>
ARRIS_TARGET_V3 std::size_t collect_avx2(const CandidateSet<float>& c, const NearestQuery<float>& q, float limit,
                                         float* d2_out, std::uint32_t* candidate_out) {
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
    if constexpr (kIndices) {
      const __m256i index = _mm256_add_epi32(_mm256_set1_epi32(static_cast<std::int32_t>(i)), order);
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(candidate_out + n), index);
    }
    n += static_cast<std::size_t>(__builtin_popcount(static_cast<unsigned>(mask)));
  }
  return n;
}
#endif

template <bool kIndices, class T>
std::size_t collect(const CandidateSet<T>& c, const NearestQuery<T>& q, T limit, T* d2, std::uint32_t* candidate) {
#if ARRIS_X86_KERNELS
  if constexpr (std::is_same_v<T, float>) {
    if (simd::widest_bytes() == 64) return collect_avx512<kIndices>(c, q, limit, d2, candidate);
    if (simd::widest_bytes() == 32) return collect_avx2<kIndices>(c, q, limit, d2, candidate);
  }
#endif
  return collect_within<kIndices>(c, q, limit, d2, candidate);
}

template <bool kIndices, class T>
Collected<T> collect_enough(const CandidateSet<T>& candidates, const NearestQuery<T>& query,
                            NearestScratch<T>& scratch) {
  scratch.make_room(candidates.count);
  T limit = std::min(query.guess_d2, query.max_d2);
  for (;;) {
    const std::size_t n = collect<kIndices>(candidates, query, limit, scratch.d2.data(), scratch.candidate.data());
    if (n > query.k || limit >= query.max_d2) return {n, limit};
    // On a surface the number grows with the square of the distance; a little more, so that the next try is the last.
    const double growth = std::clamp(1.3 * static_cast<double>(query.k + 1) / static_cast<double>(n + 1), 1.3, 8.0);
    const double next = static_cast<double>(limit) * growth + 1.0;
    limit = next >= static_cast<double>(query.max_d2) ? query.max_d2 : static_cast<T>(next);
  }
}

}  // namespace

template <class T>
Collected<T> collect_nearest(const CandidateSet<T>& candidates, const NearestQuery<T>& query,
                             NearestScratch<T>& scratch) {
  return collect_enough<true>(candidates, query, scratch);
}

template <class T>
Collected<T> collect_nearest_distances(const CandidateSet<T>& candidates, const NearestQuery<T>& query,
                                       NearestScratch<T>& scratch) {
  return collect_enough<false>(candidates, query, scratch);
}

template Collected<float> collect_nearest(const CandidateSet<float>&, const NearestQuery<float>&,
                                          NearestScratch<float>&);
template Collected<double> collect_nearest(const CandidateSet<double>&, const NearestQuery<double>&,
                                           NearestScratch<double>&);
template Collected<std::int64_t> collect_nearest(const CandidateSet<std::int64_t>&, const NearestQuery<std::int64_t>&,
                                                 NearestScratch<std::int64_t>&);
template Collected<float> collect_nearest_distances(const CandidateSet<float>&, const NearestQuery<float>&,
                                                    NearestScratch<float>&);
template Collected<double> collect_nearest_distances(const CandidateSet<double>&, const NearestQuery<double>&,
                                                     NearestScratch<double>&);
template Collected<std::int64_t> collect_nearest_distances(const CandidateSet<std::int64_t>&,
                                                           const NearestQuery<std::int64_t>&,
                                                           NearestScratch<std::int64_t>&);

}  // namespace arris
