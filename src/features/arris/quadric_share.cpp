#include "features/arris/quadric_share.h"

#include <algorithm>
#include <cmath>

#include "features/numerics/least_squares.h"

namespace arris {
namespace {

constexpr int kRegressorBits = 5;
constexpr int kOffsetBits = 10;
constexpr int kUnknowns = 6;
constexpr int kTerms = kUnknowns + 1;  // With the height as the last.

struct SumProducts {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const BallPoints& p, double radius2, const FittedPlane& plane,
                                      double (&out)[kTerms][kTerms]) {
    using V = typename simd::Wide<Bytes>::Double;
    V sums[kTerms][kTerms]{};
    for (std::size_t i = 0; i < p.padded_count(); i += Bytes / sizeof(double)) {
      const V x = simd::load<V>(p.x.data() + i), y = simd::load<V>(p.y.data() + i), z = simd::load<V>(p.z.data() + i);
      const V in = simd::where_at_most(x * x + y * y + z * z, radius2);
      const V u = on_grid<kRegressorBits>(in * (plane.e1[0] * x + plane.e1[1] * y + plane.e1[2] * z));
      const V v = on_grid<kRegressorBits>(in * (plane.e2[0] * x + plane.e2[1] * y + plane.e2[2] * z));
      const V w =
          on_grid<kOffsetBits>(in * (plane.normal[0] * x + plane.normal[1] * y + plane.normal[2] * z - plane.offset));
      const V terms[kTerms] = {in, u, v, u * u, u * v, v * v, w};
      for (int a = 0; a < kTerms; ++a) {
        for (int b = 0; b <= a; ++b) sums[a][b] += terms[a] * terms[b];
      }
    }
    for (int a = 0; a < kTerms; ++a) {
      for (int b = 0; b <= a; ++b) out[a][b] = simd::lane_sum(sums[a][b]);
    }
  }
};

}  // namespace

double quadric_share(const BallPoints& points, double radius, const FittedPlane& plane) {
  double products[kTerms][kTerms] = {};
  simd::dispatch<SumProducts>(points, radius * radius, plane, products);
  const double n = products[0][0];
  const double flat = products[kUnknowns][kUnknowns];
  if (n <= kUnknowns + 2.0 || !(flat > 0.0)) return 1.0;
  double m[kUnknowns][kUnknowns] = {};
  double y[kUnknowns];
  for (int a = 0; a < kUnknowns; ++a) {
    for (int b = 0; b <= a; ++b) m[a][b] = products[a][b];
    y[a] = products[kUnknowns][a];
  }
  double x[kUnknowns] = {};
  double variance = 0.0;
  if (!solve_normal_equations<kUnknowns>(m, y, kUnknowns, x, variance)) return 1.0;
  double bent = flat;
  for (int a = 0; a < kUnknowns; ++a) bent -= x[a] * y[a];
  return std::sqrt(std::max(bent, 0.0) / (n - kUnknowns) / (flat / (n - 3.0)));
}

}  // namespace arris
