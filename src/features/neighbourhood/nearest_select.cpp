#include "features/neighbourhood/nearest_select.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "features/numerics/simd_compact.h"

namespace arris {
namespace {

/// A key is a squared distance followed by the place in the list, so that no two are equal.
constexpr int kPlaceBits = 7;
/// More than this many do not fit a key; about there a comparison sort begins to beat counting.
constexpr std::size_t kMostRanked = std::size_t{1} << kPlaceBits;
static_assert(kExactSquares<float> * kMostRanked <= 2147483648.0 && kExactSquares<double> * kMostRanked <= 9.2e18);

template <class T>
ARRIS_ALWAYS_INLINE std::size_t collect_within(const CandidateSet<T>& c, const NearestQuery<T>& q, T limit, T* d2_out,
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
      candidate_out[n] = static_cast<std::uint32_t>(begin + i);
      n += d2[i] <= limit;
    }
  }
  return n;
}

#if ARRIS_X86_KERNELS
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
    _mm512_storeu_si512(candidate_out + n, _mm512_maskz_compress_epi32(in, index));
    n += static_cast<std::size_t>(__builtin_popcount(in));
    index = _mm512_add_epi32(index, _mm512_set1_epi32(16));
  }
  return n;
}

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
    const __m256i index = _mm256_add_epi32(_mm256_set1_epi32(static_cast<std::int32_t>(i)), order);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(candidate_out + n), index);
    n += static_cast<std::size_t>(__builtin_popcount(static_cast<unsigned>(mask)));
  }
  return n;
}
#endif

template <class T>
std::size_t collect(const CandidateSet<T>& c, const NearestQuery<T>& q, T limit, T* d2, std::uint32_t* candidate) {
#if ARRIS_X86_KERNELS
  if constexpr (std::is_same_v<T, float>) {
    if (simd::widest_bytes() == 64) return collect_avx512(c, q, limit, d2, candidate);
    if (simd::widest_bytes() == 32) return collect_avx2(c, q, limit, d2, candidate);
  }
#endif
  return collect_within(c, q, limit, d2, candidate);
}

/// rank[i] = how many of the n <= kMostRanked values are smaller than values[i], or equal and further in front.
struct CountSmaller {
  template <int Bytes, class T>
  static ARRIS_ALWAYS_INLINE void run(const T* values, std::size_t n, std::int32_t* rank) {
    using V = typename simd::VectorOf<T, Bytes>::Type;
    using Keys = typename simd::VectorOf<T, Bytes>::Mask;
    using Key = std::conditional_t<std::is_same_v<T, float>, std::int32_t, std::int64_t>;
    constexpr std::size_t kLanes = simd::VectorOf<T, Bytes>::kLanes;
    alignas(64) Key keys[kMostRanked];
    Keys place;
    for (std::size_t lane = 0; lane < kLanes; ++lane) place[lane] = static_cast<Key>(lane);
    for (std::size_t block = 0; block < n; block += kLanes) {
      simd::store(keys + block, (__builtin_convertvector(simd::load<V>(values + block), Keys) << kPlaceBits) + place);
      place += static_cast<Key>(kLanes);
    }
    for (std::size_t block = 0; block < n; block += kLanes) {
      const auto mine = simd::load<Keys>(keys + block);
      Keys smaller{};
      for (std::size_t j = 0; j < n; ++j) smaller -= (mine > keys[j]);
      for (std::size_t lane = 0; lane < kLanes; ++lane) rank[block + lane] = static_cast<std::int32_t>(smaller[lane]);
    }
  }
};

template <class T>
void sort_by_rank(NearestScratch<T>& s, std::size_t n) {
  const T* values = s.d2.data();
  for (std::size_t i = n; i < simd::padded(n); ++i) s.d2[i] = T{0};  // Ranked too, but nobody asks for it.
  simd::dispatch<CountSmaller>(values, n, s.rank.data());
  for (std::size_t i = 0; i < n; ++i) {
    const auto place = static_cast<std::size_t>(s.rank[i]);
    s.sorted[place] = s.candidate[i];
    s.sorted_d2[place] = s.d2[i];
  }
}

/// Whether any of the first `wanted` is as far as the one after it.
template <class T>
bool has_ties(const NearestScratch<T>& s, std::size_t n, std::size_t wanted) {
  int ties = 0;
  for (std::size_t i = 0; i < std::min(wanted, n - 1); ++i) ties |= s.sorted_d2[i] == s.sorted_d2[i + 1];
  return ties != 0;
}

template <class T>
void sort_by_comparison(NearestScratch<T>& s, std::size_t n, std::size_t wanted) {
  auto& pairs = s.pairs;
  pairs.resize(n);
  for (std::size_t i = 0; i < n; ++i) pairs[i] = {s.d2[i], s.candidate[i]};
  if (wanted < n) {
    // Everything that ties with the last one wanted must stay in.
    std::nth_element(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(wanted - 1), pairs.end());
    const T last = pairs[wanted - 1].first;
    const auto cut = std::partition(pairs.begin() + static_cast<std::ptrdiff_t>(wanted), pairs.end(),
                                    [last](const auto& pair) { return pair.first == last; });
    pairs.erase(cut, pairs.end());
  }
  std::sort(pairs.begin(), pairs.end());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    s.sorted_d2[i] = pairs[i].first;
    s.sorted[i] = pairs[i].second;
  }
  for (std::size_t i = pairs.size(); i < n; ++i) s.sorted_d2[i] = std::numeric_limits<T>::max();
}

/// Puts runs of equal distances that begin before `wanted` into the order of ids.
template <class T>
void order_ties(const PointTree& tree, const CandidateSet<T>& candidates, NearestScratch<T>& s, std::size_t n,
                std::size_t wanted) {
  for (std::size_t begin = 0; begin < wanted;) {
    std::size_t end = begin + 1;
    while (end < n && s.sorted_d2[end] == s.sorted_d2[begin]) ++end;
    if (end - begin > 1) {
      std::sort(
          s.sorted.begin() + static_cast<std::ptrdiff_t>(begin), s.sorted.begin() + static_cast<std::ptrdiff_t>(end),
          [&](std::uint32_t a, std::uint32_t b) { return tree.id(candidates.slot[a]) < tree.id(candidates.slot[b]); });
    }
    begin = end;
  }
}

}  // namespace

template <class T>
void select_nearest(const PointTree& tree, const CandidateSet<T>& candidates, const NearestQuery<T>& query,
                    NearestScratch<T>& scratch, Neighbours& found) {
  const std::size_t room = simd::padded(candidates.count) + simd::kPadding;
  if (scratch.d2.size() < room) {
    scratch.d2.resize(room);
    scratch.candidate.resize(room);
    scratch.rank.resize(room);
    scratch.sorted.resize(room);
    scratch.sorted_d2.resize(room);
  }
  T limit = std::min(query.guess_d2, query.max_d2);
  std::size_t n = 0;
  for (;;) {
    n = collect(candidates, query, limit, scratch.d2.data(), scratch.candidate.data());
    if (n > query.k || limit >= query.max_d2) break;
    // On a surface the number grows with the square of the distance; a little more, so that the next try is the last.
    const double growth = std::clamp(1.3 * static_cast<double>(query.k + 1) / static_cast<double>(n + 1), 1.5, 8.0);
    const double next = static_cast<double>(limit) * growth + 1.0;
    limit = next >= static_cast<double>(query.max_d2) ? query.max_d2 : static_cast<T>(next);
  }
  const std::size_t wanted = std::min(n, query.k + 1);  // With the query itself, which comes first.
  if constexpr (std::is_same_v<T, std::int64_t>) {
    sort_by_comparison(scratch, n, wanted);
  } else if (n <= kMostRanked) {
    sort_by_rank(scratch, n);
  } else {
    sort_by_comparison(scratch, n, wanted);
  }
  if (has_ties(scratch, n, wanted)) order_ties(tree, candidates, scratch, n, wanted);
  found.count = wanted - 1;
  for (std::size_t i = 0; i < found.count; ++i) {
    const std::uint32_t c = scratch.sorted[i + 1];
    found.dx[i] = static_cast<double>(candidates.x[c] - query.x);
    found.dy[i] = static_cast<double>(candidates.y[c] - query.y);
    found.dz[i] = static_cast<double>(candidates.z[c] - query.z);
    found.d2[i] = static_cast<double>(scratch.sorted_d2[i + 1]);
    found.slot[i] = candidates.slot[c];
  }
  for (std::size_t i = found.count; i < simd::padded(found.count); ++i) {
    found.dx[i] = found.dy[i] = found.dz[i] = found.d2[i] = 0.0;
  }
  found.last_d2 = found.count > 0 ? static_cast<std::uint64_t>(scratch.sorted_d2[found.count]) : 0;
}

template void select_nearest(const PointTree&, const CandidateSet<float>&, const NearestQuery<float>&,
                             NearestScratch<float>&, Neighbours&);
template void select_nearest(const PointTree&, const CandidateSet<double>&, const NearestQuery<double>&,
                             NearestScratch<double>&, Neighbours&);
template void select_nearest(const PointTree&, const CandidateSet<std::int64_t>&, const NearestQuery<std::int64_t>&,
                             NearestScratch<std::int64_t>&, Neighbours&);

}  // namespace arris
