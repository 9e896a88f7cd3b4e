#include "features/neighbourhood/product_sums.h"

#include <bit>

#include "features/numerics/exact_sums.h"

namespace arris {
namespace {

/// Sums of products relative to the origin; all else is relative to the centre.
/// @param Whole  the total of all lanes fits into 32 bits, too, which saves the conversions of lanes.
template <bool Whole>
struct AddProducts {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const CandidateSet<float>& c, const BallQuery<float>& ball, BallMoments& out) {
    using V = typename simd::Wide<Bytes>::Float;
    using Integers = typename simd::Wide<Bytes>::Int;
    using Words = typename simd::Wide<Bytes>::Word;  // What is not inside may overflow.
    const CandidateProducts& p = c.products;
    V n{}, x{}, y{}, z{};
    Words xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
    for (std::size_t i = 0; i < simd::padded(c.count); i += Bytes / sizeof(float)) {
      const V dx = simd::load<V>(c.x.data() + i) - ball.x;
      const V dy = simd::load<V>(c.y.data() + i) - ball.y;
      const V dz = simd::load<V>(c.z.data() + i) - ball.z;
      const auto inside = simd::exact_multiply_add(dz, dz, simd::exact_multiply_add(dy, dy, dx * dx)) <= ball.radius2;
      n = inside ? n + 1.0F : n;
      x = inside ? x + dx : x;
      y = inside ? y + dy : y;
      z = inside ? z + dz : z;
      xx = inside ? xx + simd::load<Words>(p.xx.data() + i) : xx;
      xy = inside ? xy + simd::load<Words>(p.xy.data() + i) : xy;
      xz = inside ? xz + simd::load<Words>(p.xz.data() + i) : xz;
      yy = inside ? yy + simd::load<Words>(p.yy.data() + i) : yy;
      yz = inside ? yz + simd::load<Words>(p.yz.data() + i) : yz;
      zz = inside ? zz + simd::load<Words>(p.zz.data() + i) : zz;
    }
    const V floats[] = {n, x, y, z};
    const Words words[] = {xx, xy, xz, yy, yz, zz};
    if constexpr (Whole) {
      out = total<Integers>(
          floats, words,
          [](const auto& v) __attribute__((always_inline)) { return __builtin_convertvector(v, Integers); });
    } else {
      out = total<typename simd::Wide<Bytes>::Double>(
          floats, words, [](const auto& v) __attribute__((always_inline)) { return simd::exact_doubles(v); });
    }
  }

 private:
  template <class Sum, class V, class Words, class Convert>
  static ARRIS_ALWAYS_INLINE BallMoments total(const V (&floats)[4], const Words (&words)[6], const Convert& convert) {
    using Integers = typename simd::Wide<sizeof(Words)>::Int;
    Sum sums[10];
    for (int i = 0; i < 4; ++i) sums[i] = convert(floats[i]);
    for (int i = 0; i < 6; ++i) sums[4 + i] = convert(std::bit_cast<Integers>(words[i]));
    const auto totals = simd::exact_lane_sums(sums);
    std::array<double, 10> doubles;
    for (int i = 0; i < 10; ++i) doubles[i] = static_cast<double>(totals[i]);
    return std::bit_cast<BallMoments>(doubles);
  }
};

/// Makes the sums of products relative to the centre (x, y, z), too; exact while all is below 2^53.
BallMoments about_centre(const BallMoments& m, double x, double y, double z) {
  return {m.n,
          m.x,
          m.y,
          m.z,
          m.xx - 2.0 * x * m.x - m.n * x * x,
          m.xy - x * m.y - y * m.x - m.n * x * y,
          m.xz - x * m.z - z * m.x - m.n * x * z,
          m.yy - 2.0 * y * m.y - m.n * y * y,
          m.yz - y * m.z - z * m.y - m.n * y * z,
          m.zz - 2.0 * z * m.z - m.n * z * z};
}

}  // namespace

BallMoments add_products(const CandidateSet<float>& candidates, const BallQuery<float>& ball) {
  BallMoments moments;
  if (candidates.products.whole) {
    simd::dispatch<AddProducts<true>>(candidates, ball, moments);
  } else {
    simd::dispatch<AddProducts<false>>(candidates, ball, moments);
  }
  return about_centre(moments, ball.x, ball.y, ball.z);
}

}  // namespace arris
