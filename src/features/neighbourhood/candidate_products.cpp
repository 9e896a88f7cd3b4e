#include "features/neighbourhood/candidate_products.h"

#include <bit>

#include "features/numerics/simd.h"

namespace arris {
namespace {

constexpr double kMostSum = 2147483647.0;

struct Multiply {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const float* const (&from)[3], std::size_t count, std::int32_t* const (&to)[6]) {
    using Floats = typename simd::Wide<Bytes>::Float;
    using Integers = typename simd::Wide<Bytes>::Int;
    // The low halves of products are the same without signs, and those of the padding may overflow.
    using Words = typename simd::Wide<Bytes>::Word;
    for (std::size_t i = 0; i < count; i += Bytes / sizeof(float)) {
      const auto at = [&](int axis) __attribute__((always_inline)) {
        return std::bit_cast<Words>(__builtin_convertvector(simd::load<Floats>(from[axis] + i), Integers));
      };
      const Words x = at(0), y = at(1), z = at(2);
      simd::store(to[0] + i, x * x);
      simd::store(to[1] + i, x * y);
      simd::store(to[2] + i, x * z);
      simd::store(to[3] + i, y * y);
      simd::store(to[4] + i, y * z);
      simd::store(to[5] + i, z * z);
    }
  }
};

}  // namespace

void CandidateProducts::make(const PageVector<float>& x, const PageVector<float>& y, const PageVector<float>& z,
                             std::size_t count, double farthest) {
  const std::size_t lanes = static_cast<std::size_t>(simd::widest_bytes()) / sizeof(std::int32_t);
  const auto per_lane = static_cast<double>(simd::padded(count) / lanes);
  exact = per_lane * farthest * farthest <= kMostSum;
  whole = static_cast<double>(count) * farthest * farthest <= kMostSum;
  if (!exact) return;
  PageVector<std::int32_t>* const columns[] = {&xx, &xy, &xz, &yy, &yz, &zz};
  for (auto* column : columns) {
    if (column->size() < simd::padded(count)) column->resize(x.size());
  }
  // The padding's products are of no meaning; no ball holds it.
  const float* const from[] = {x.data(), y.data(), z.data()};
  std::int32_t* const to[] = {xx.data(), xy.data(), xz.data(), yy.data(), yz.data(), zz.data()};
  simd::dispatch<Multiply>(from, simd::padded(count), to);
}

}  // namespace arris
