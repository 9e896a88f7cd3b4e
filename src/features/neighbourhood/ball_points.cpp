#include "features/neighbourhood/ball_points.h"

#include <algorithm>
#include <type_traits>

#include "features/numerics/simd_compact.h"

namespace arris {
namespace {

/// Candidates that are looked at before there must be room for more members: a multiple of simd::kPadding.
constexpr std::size_t kBlock = 2048;

/// Candidates from `begin` on, at most kBlock of them; appends to `n` members, and writes up to simd::kPadding entries
/// past them. @return members.
template <class T>
std::size_t collect(const CandidateSet<T>& c, std::size_t begin, const BallQuery<T>& ball, double inverse,
                    BallPoints& points, std::size_t n) {
  const std::size_t end = std::min(c.count, begin + kBlock);
  for (std::size_t i = begin; i < end; ++i) {
    const T dx = bounded<T>(c.x[i] - ball.x);
    const T dy = bounded<T>(c.y[i] - ball.y);
    const T dz = bounded<T>(c.z[i] - ball.z);
    // Without branches: every point is written, and the end advances past members only.
    points.x[n] = on_grid<kCoordinateBits>(static_cast<double>(dx) * inverse);
    points.y[n] = on_grid<kCoordinateBits>(static_cast<double>(dy) * inverse);
    points.z[n] = on_grid<kCoordinateBits>(static_cast<double>(dz) * inverse);
    n += dx * dx + dy * dy + dz * dz <= ball.radius2;
  }
  return n;
}

std::size_t keep(const BallPoints& p, double radius2, BallPoints& kept) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < p.count; ++i) {
    const double x = p.x[i], y = p.y[i], z = p.z[i];
    kept.x[n] = x;
    kept.y[n] = y;
    kept.z[n] = z;
    n += x * x + y * y + z * z <= radius2;
  }
  return n;
}

#if ARRIS_X86_KERNELS
ARRIS_TARGET_V4 std::size_t keep_avx512(const BallPoints& p, double radius2, BallPoints& kept) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < p.padded_count(); i += 8) {  // The padding is outside of every ball.
    const __m512d x = _mm512_loadu_pd(p.x.data() + i);
    const __m512d y = _mm512_loadu_pd(p.y.data() + i);
    const __m512d z = _mm512_loadu_pd(p.z.data() + i);
    const __m512d d2 = _mm512_add_pd(_mm512_add_pd(_mm512_mul_pd(x, x), _mm512_mul_pd(y, y)), _mm512_mul_pd(z, z));
    const __mmask8 in = _mm512_cmp_pd_mask(d2, _mm512_set1_pd(radius2), _CMP_LE_OQ);
    _mm512_storeu_pd(kept.x.data() + n, _mm512_maskz_compress_pd(in, x));
    _mm512_storeu_pd(kept.y.data() + n, _mm512_maskz_compress_pd(in, y));
    _mm512_storeu_pd(kept.z.data() + n, _mm512_maskz_compress_pd(in, z));
    n += static_cast<std::size_t>(__builtin_popcount(in));
  }
  return n;
}

ARRIS_TARGET_V4 std::size_t collect_avx512(const CandidateSet<float>& c, std::size_t begin,
                                           const BallQuery<float>& ball, double inverse, BallPoints& points,
                                           std::size_t n) {
  const float* const from[3] = {c.x.data(), c.y.data(), c.z.data()};
  double* const to[3] = {points.x.data(), points.y.data(), points.z.data()};
  const float centre[3] = {ball.x, ball.y, ball.z};
  const std::size_t end = std::min(simd::padded(c.count), begin + kBlock);
  for (std::size_t i = begin; i < end; i += 16) {  // The padding is outside of every ball.
    __m512 d[3];
    for (int axis = 0; axis < 3; ++axis) {
      d[axis] = _mm512_sub_ps(_mm512_loadu_ps(from[axis] + i), _mm512_set1_ps(centre[axis]));
    }
    const __m512 d2 =
        _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(d[0], d[0]), _mm512_mul_ps(d[1], d[1])), _mm512_mul_ps(d[2], d[2]));
    const __mmask16 in = _mm512_cmp_ps_mask(d2, _mm512_set1_ps(ball.radius2), _CMP_LE_OQ);
    if (in == 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const __m512 members = _mm512_maskz_compress_ps(in, d[axis]);
      const __m512d low = _mm512_cvtps_pd(_mm512_castps512_ps256(members));
      const __m512d high = _mm512_cvtps_pd(_mm512_extractf32x8_ps(members, 1));
      simd::store(to[axis] + n, on_grid<kCoordinateBits>(low * inverse));
      simd::store(to[axis] + n + 8, on_grid<kCoordinateBits>(high * inverse));
    }
    n += static_cast<std::size_t>(__builtin_popcount(in));
  }
  return n;
}

ARRIS_TARGET_V4 std::size_t collect_avx512(const CandidateSet<double>& c, std::size_t begin,
                                           const BallQuery<double>& ball, double inverse, BallPoints& points,
                                           std::size_t n) {
  const double* const from[3] = {c.x.data(), c.y.data(), c.z.data()};
  double* const to[3] = {points.x.data(), points.y.data(), points.z.data()};
  const double centre[3] = {ball.x, ball.y, ball.z};
  const std::size_t end = std::min(simd::padded(c.count), begin + kBlock);
  for (std::size_t i = begin; i < end; i += 8) {
    __m512d d[3];
    for (int axis = 0; axis < 3; ++axis) {
      d[axis] = _mm512_sub_pd(_mm512_loadu_pd(from[axis] + i), _mm512_set1_pd(centre[axis]));
    }
    const __m512d d2 =
        _mm512_add_pd(_mm512_add_pd(_mm512_mul_pd(d[0], d[0]), _mm512_mul_pd(d[1], d[1])), _mm512_mul_pd(d[2], d[2]));
    const __mmask8 in = _mm512_cmp_pd_mask(d2, _mm512_set1_pd(ball.radius2), _CMP_LE_OQ);
    if (in == 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      simd::store(to[axis] + n, on_grid<kCoordinateBits>(_mm512_maskz_compress_pd(in, d[axis]) * inverse));
    }
    n += static_cast<std::size_t>(__builtin_popcount(in));
  }
  return n;
}

ARRIS_TARGET_V3 std::size_t collect_avx2(const CandidateSet<float>& c, std::size_t begin, const BallQuery<float>& ball,
                                         double inverse, BallPoints& points, std::size_t n) {
  const float* const from[3] = {c.x.data(), c.y.data(), c.z.data()};
  double* const to[3] = {points.x.data(), points.y.data(), points.z.data()};
  const float centre[3] = {ball.x, ball.y, ball.z};
  const std::size_t end = std::min(simd::padded(c.count), begin + kBlock);
  for (std::size_t i = begin; i < end; i += 8) {
    __m256 d[3];
    for (int axis = 0; axis < 3; ++axis) {
      d[axis] = _mm256_sub_ps(_mm256_loadu_ps(from[axis] + i), _mm256_set1_ps(centre[axis]));
    }
    const __m256 d2 =
        _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(d[0], d[0]), _mm256_mul_ps(d[1], d[1])), _mm256_mul_ps(d[2], d[2]));
    const int in = _mm256_movemask_ps(_mm256_cmp_ps(d2, _mm256_set1_ps(ball.radius2), _CMP_LE_OQ));
    if (in == 0) continue;
    const __m256i order = _mm256_load_si256(reinterpret_cast<const __m256i*>(simd::kCompactTable.lanes[in]));
    for (int axis = 0; axis < 3; ++axis) {
      const __m256 members = _mm256_permutevar8x32_ps(d[axis], order);
      const __m256d low = _mm256_cvtps_pd(_mm256_castps256_ps128(members));
      const __m256d high = _mm256_cvtps_pd(_mm256_extractf128_ps(members, 1));
      simd::store(to[axis] + n, on_grid<kCoordinateBits>(low * inverse));
      simd::store(to[axis] + n + 4, on_grid<kCoordinateBits>(high * inverse));
    }
    n += static_cast<std::size_t>(__builtin_popcount(static_cast<unsigned>(in)));
  }
  return n;
}
#endif

template <class T>
std::size_t collect_best(const CandidateSet<T>& c, std::size_t begin, const BallQuery<T>& ball, double inverse,
                         BallPoints& points, std::size_t n) {
#if ARRIS_X86_KERNELS
  if constexpr (!std::is_same_v<T, std::int64_t>) {
    if (simd::widest_bytes() == 64) return collect_avx512(c, begin, ball, inverse, points, n);
  }
  if constexpr (std::is_same_v<T, float>) {
    if (simd::widest_bytes() == 32) return collect_avx2(c, begin, ball, inverse, points, n);
  }
#endif
  return collect(c, begin, ball, inverse, points, n);
}

}  // namespace

void BallPoints::make_room(std::size_t most) {
  const std::size_t room = simd::padded(most) + simd::kPadding;
  if (x.size() >= room) return;
  for (auto* column : {&x, &y, &z}) column->resize(std::max(room, column->size() + column->size() / 2));
}

void BallPoints::finish(std::size_t points) {
  count = points;
  for (std::size_t i = points; i < padded_count(); ++i) x[i] = y[i] = z[i] = kPaddingCoordinate;
}

template <class T>
void collect_ball(const CandidateSet<T>& c, const BallQuery<T>& ball, double spacing, BallPoints& points) {
  std::size_t n = 0;
  // Candidates are many times as many as members where few points have many around them.
  for (std::size_t begin = 0; begin < c.count; begin += kBlock) {
    points.make_room(n + kBlock);
    n = collect_best(c, begin, ball, 1.0 / spacing, points, n);
  }
  points.finish(n);
}

void keep_within(const BallPoints& points, double radius, BallPoints& kept) {
  kept.make_room(points.count);
#if ARRIS_X86_KERNELS
  if (simd::widest_bytes() == 64) return kept.finish(keep_avx512(points, radius * radius, kept));
#endif
  kept.finish(keep(points, radius * radius, kept));
}

template void collect_ball(const CandidateSet<float>&, const BallQuery<float>&, double, BallPoints&);
template void collect_ball(const CandidateSet<double>&, const BallQuery<double>&, double, BallPoints&);
template void collect_ball(const CandidateSet<std::int64_t>&, const BallQuery<std::int64_t>&, double, BallPoints&);

}  // namespace arris
