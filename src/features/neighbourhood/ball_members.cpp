#include "features/neighbourhood/ball_members.h"

#include <type_traits>

#include "features/numerics/simd_compact.h"

namespace arris {
namespace {

#if ARRIS_X86_KERNELS
ARRIS_TARGET_V4 std::size_t list_avx512(const CandidateSet<float>& c, const BallQuery<float>& ball,
                                        std::uint32_t* members) {
  __m512i index = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  std::size_t n = 0;
  for (std::size_t i = 0; i < c.count; i += 16) {  // The padding is outside of every ball.
    const __m512 dx = _mm512_sub_ps(_mm512_loadu_ps(c.x.data() + i), _mm512_set1_ps(ball.x));
    const __m512 dy = _mm512_sub_ps(_mm512_loadu_ps(c.y.data() + i), _mm512_set1_ps(ball.y));
    const __m512 dz = _mm512_sub_ps(_mm512_loadu_ps(c.z.data() + i), _mm512_set1_ps(ball.z));
    const __m512 d2 = _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(dx, dx), _mm512_mul_ps(dy, dy)), _mm512_mul_ps(dz, dz));
    const __mmask16 in = _mm512_cmp_ps_mask(d2, _mm512_set1_ps(ball.radius2), _CMP_LE_OQ);
    _mm512_storeu_si512(members + n, _mm512_maskz_compress_epi32(in, index));
    n += static_cast<std::size_t>(__builtin_popcount(in));
    index = _mm512_add_epi32(index, _mm512_set1_epi32(16));
  }
  return n;
}
#endif

template <class T>
std::size_t list(const CandidateSet<T>& c, const BallQuery<T>& ball, std::uint32_t* members) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < c.count; ++i) {
    const T dx = bounded<T>(c.x[i] - ball.x);
    const T dy = bounded<T>(c.y[i] - ball.y);
    const T dz = bounded<T>(c.z[i] - ball.z);
    members[n] = static_cast<std::uint32_t>(i);
    n += dx * dx + dy * dy + dz * dz <= ball.radius2;
  }
  return n;
}

}  // namespace

template <class T>
std::size_t ball_members(const CandidateSet<T>& c, const BallQuery<T>& ball, std::vector<std::uint32_t>& members) {
  const std::size_t room = simd::padded(c.count) + simd::kPadding;  // Whole vectors are written.
  if (members.size() < room) members.resize(room);
#if ARRIS_X86_KERNELS
  if constexpr (std::is_same_v<T, float>) {
    if (simd::widest_bytes() == 64) return list_avx512(c, ball, members.data());
  }
#endif
  return list(c, ball, members.data());
}

template std::size_t ball_members(const CandidateSet<float>&, const BallQuery<float>&, std::vector<std::uint32_t>&);
template std::size_t ball_members(const CandidateSet<double>&, const BallQuery<double>&, std::vector<std::uint32_t>&);
template std::size_t ball_members(const CandidateSet<std::int64_t>&, const BallQuery<std::int64_t>&,
                                  std::vector<std::uint32_t>&);

}  // namespace arris
