#include "features/neighbourhood/candidate_window.h"

#include <algorithm>

#include "features/numerics/simd_compact.h"

namespace arris {
namespace {

/// The points [begin, end) that are near enough; returns the new count. Writes up to end - begin entries past it.
template <class T>
std::size_t append(const PointTree& tree, std::size_t begin, std::size_t end, const Window<T>& w, CandidateSet<T>& out,
                   std::size_t n) {
  for (std::size_t i = begin; i < end; ++i) {
    // Without branches: every point is written, and the end advances as the point deserves.
    const T px = static_cast<T>(tree.x()[i] - w.origin[0]);
    const T py = static_cast<T>(tree.y()[i] - w.origin[1]);
    const T pz = static_cast<T>(tree.z()[i] - w.origin[2]);
    const T gx = bounded<T>(std::max(std::max(w.low[0] - px, px - w.high[0]), T{0}));
    const T gy = bounded<T>(std::max(std::max(w.low[1] - py, py - w.high[1]), T{0}));
    const T gz = bounded<T>(std::max(std::max(w.low[2] - pz, pz - w.high[2]), T{0}));
    out.x[n] = px;
    out.y[n] = py;
    out.z[n] = pz;
    out.slot[n] = static_cast<std::uint32_t>(i);
    n += gx * gx + gy * gy + gz * gz <= w.reach2;
  }
  return n;
}

#if ARRIS_X86_KERNELS
ARRIS_TARGET_V4 std::size_t append_avx512(const PointTree& tree, std::size_t begin, std::size_t end,
                                          const Window<float>& w, CandidateSet<float>& out, std::size_t n) {
  const __m512i slots = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const std::int32_t* axes[3] = {tree.x(), tree.y(), tree.z()};
  for (std::size_t i = begin; i < end; i += 16) {
    const std::size_t left = end - i;
    const auto valid = static_cast<__mmask16>(left >= 16 ? 0xffffU : (1U << left) - 1U);
    __m512 p[3];
    __m512 d2 = _mm512_setzero_ps();
    for (int axis = 0; axis < 3; ++axis) {
      // The caller has checked that the difference fits; the origin itself is a lattice coordinate.
      const __m512i origin = _mm512_set1_epi32(static_cast<std::int32_t>(w.origin[axis]));
      p[axis] = _mm512_cvtepi32_ps(_mm512_sub_epi32(_mm512_maskz_loadu_epi32(valid, axes[axis] + i), origin));
      const __m512 below = _mm512_sub_ps(_mm512_set1_ps(w.low[axis]), p[axis]);
      const __m512 above = _mm512_sub_ps(p[axis], _mm512_set1_ps(w.high[axis]));
      const __m512 gap = _mm512_max_ps(_mm512_max_ps(below, above), _mm512_setzero_ps());
      d2 = _mm512_add_ps(d2, _mm512_mul_ps(gap, gap));
    }
    const __mmask16 in = _mm512_mask_cmp_ps_mask(valid, d2, _mm512_set1_ps(w.reach2), _CMP_LE_OQ);
    if (in == 0) continue;
    _mm512_storeu_ps(out.x.data() + n, _mm512_maskz_compress_ps(in, p[0]));
    _mm512_storeu_ps(out.y.data() + n, _mm512_maskz_compress_ps(in, p[1]));
    _mm512_storeu_ps(out.z.data() + n, _mm512_maskz_compress_ps(in, p[2]));
    const __m512i index = _mm512_add_epi32(_mm512_set1_epi32(static_cast<std::int32_t>(i)), slots);
    _mm512_storeu_si512(out.slot.data() + n, _mm512_maskz_compress_epi32(in, index));
    n += static_cast<std::size_t>(__builtin_popcount(in));
  }
  return n;
}

ARRIS_TARGET_V4 std::size_t append_avx512(const PointTree& tree, std::size_t begin, std::size_t end,
                                          const Window<double>& w, CandidateSet<double>& out, std::size_t n) {
  const __m256i slots = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const std::int32_t* axes[3] = {tree.x(), tree.y(), tree.z()};
  for (std::size_t i = begin; i < end; i += 8) {
    const std::size_t left = end - i;
    const auto valid = static_cast<__mmask8>(left >= 8 ? 0xffU : (1U << left) - 1U);
    __m512d p[3];
    __m512d d2 = _mm512_setzero_pd();
    for (int axis = 0; axis < 3; ++axis) {
      const __m512d origin = _mm512_set1_pd(static_cast<double>(w.origin[axis]));
      p[axis] = _mm512_sub_pd(_mm512_cvtepi32_pd(_mm256_maskz_loadu_epi32(valid, axes[axis] + i)), origin);
      const __m512d below = _mm512_sub_pd(_mm512_set1_pd(w.low[axis]), p[axis]);
      const __m512d above = _mm512_sub_pd(p[axis], _mm512_set1_pd(w.high[axis]));
      const __m512d gap = _mm512_max_pd(_mm512_max_pd(below, above), _mm512_setzero_pd());
      d2 = _mm512_add_pd(d2, _mm512_mul_pd(gap, gap));
    }
    const __mmask8 in = _mm512_mask_cmp_pd_mask(valid, d2, _mm512_set1_pd(w.reach2), _CMP_LE_OQ);
    if (in == 0) continue;
    _mm512_storeu_pd(out.x.data() + n, _mm512_maskz_compress_pd(in, p[0]));
    _mm512_storeu_pd(out.y.data() + n, _mm512_maskz_compress_pd(in, p[1]));
    _mm512_storeu_pd(out.z.data() + n, _mm512_maskz_compress_pd(in, p[2]));
    const __m256i index = _mm256_add_epi32(_mm256_set1_epi32(static_cast<std::int32_t>(i)), slots);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out.slot.data() + n), _mm256_maskz_compress_epi32(in, index));
    n += static_cast<std::size_t>(__builtin_popcount(in));
  }
  return n;
}

ARRIS_TARGET_V3 std::size_t append_avx2(const PointTree& tree, std::size_t begin, std::size_t end,
                                        const Window<float>& w, CandidateSet<float>& out, std::size_t n) {
  const __m256i lanes = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const std::int32_t* axes[3] = {tree.x(), tree.y(), tree.z()};
  for (std::size_t i = begin; i < end; i += 8) {
    const auto left = static_cast<std::int32_t>(end - i);
    const __m256i valid = _mm256_cmpgt_epi32(_mm256_set1_epi32(left), lanes);
    __m256 p[3];
    __m256 d2 = _mm256_setzero_ps();
    for (int axis = 0; axis < 3; ++axis) {
      const __m256i origin = _mm256_set1_epi32(static_cast<std::int32_t>(w.origin[axis]));
      p[axis] = _mm256_cvtepi32_ps(_mm256_sub_epi32(_mm256_maskload_epi32(axes[axis] + i, valid), origin));
      const __m256 below = _mm256_sub_ps(_mm256_set1_ps(w.low[axis]), p[axis]);
      const __m256 above = _mm256_sub_ps(p[axis], _mm256_set1_ps(w.high[axis]));
      const __m256 gap = _mm256_max_ps(_mm256_max_ps(below, above), _mm256_setzero_ps());
      d2 = _mm256_add_ps(d2, _mm256_mul_ps(gap, gap));
    }
    const __m256 in =
        _mm256_and_ps(_mm256_cmp_ps(d2, _mm256_set1_ps(w.reach2), _CMP_LE_OQ), _mm256_castsi256_ps(valid));
    const int mask = _mm256_movemask_ps(in);
    if (mask == 0) continue;
    const __m256i order = _mm256_load_si256(reinterpret_cast<const __m256i*>(simd::kCompactTable.lanes[mask]));
    _mm256_storeu_ps(out.x.data() + n, _mm256_permutevar8x32_ps(p[0], order));
    _mm256_storeu_ps(out.y.data() + n, _mm256_permutevar8x32_ps(p[1], order));
    _mm256_storeu_ps(out.z.data() + n, _mm256_permutevar8x32_ps(p[2], order));
    const __m256i index = _mm256_add_epi32(_mm256_set1_epi32(static_cast<std::int32_t>(i)), order);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out.slot.data() + n), index);
    n += static_cast<std::size_t>(__builtin_popcount(static_cast<unsigned>(mask)));
  }
  return n;
}
#endif

}  // namespace

template <class T>
std::size_t append_near(const PointTree& tree, std::size_t begin, std::size_t end, const Window<T>& w,
                        CandidateSet<T>& out, std::size_t n) {
#if ARRIS_X86_KERNELS
  if constexpr (!std::is_same_v<T, std::int64_t>) {
    if (simd::widest_bytes() == 64) return append_avx512(tree, begin, end, w, out, n);
  }
  if constexpr (std::is_same_v<T, float>) {
    if (simd::widest_bytes() == 32) return append_avx2(tree, begin, end, w, out, n);
  }
#endif
  return append(tree, begin, end, w, out, n);
}

template std::size_t append_near(const PointTree&, std::size_t, std::size_t, const Window<float>&, CandidateSet<float>&,
                                 std::size_t);
template std::size_t append_near(const PointTree&, std::size_t, std::size_t, const Window<double>&,
                                 CandidateSet<double>&, std::size_t);
template std::size_t append_near(const PointTree&, std::size_t, std::size_t, const Window<std::int64_t>&,
                                 CandidateSet<std::int64_t>&, std::size_t);

}  // namespace arris
