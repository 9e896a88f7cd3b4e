#include "features/arris/curved_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "features/numerics/exact_sums.h"
#include "features/numerics/least_squares.h"

namespace arris {
namespace {

constexpr int kRegressorBits = 5;
constexpr int kOffsetBits = 10;
constexpr int kUnknowns = 5;
constexpr int kTerms = kUnknowns + 1;  // With w as the last.

struct SumProducts {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const BallPoints& p, const FoldLine& line, const Vector3& across,
                                      double (&out)[kTerms][kTerms]) {
    using V = typename simd::Wide<Bytes>::Double;
    V sums[kTerms][kTerms]{};
    for (std::size_t i = 0; i < p.padded_count(); i += Bytes / sizeof(double)) {
      const V x = simd::load<V>(p.x.data() + i);
      const V real = simd::where_above(V{} + BallPoints::kPaddingCoordinate, x);
      const V y = simd::load<V>(p.y.data() + i);
      const V z = simd::load<V>(p.z.data() + i);
      V t = line.direction[0] * x + line.direction[1] * y + line.direction[2] * z;
      V v = across[0] * x + across[1] * y + across[2] * z;
      V w = line.opening[0] * x + line.opening[1] * y + line.opening[2] * z;
      t = on_grid<kRegressorBits>(real * t);
      v = on_grid<kRegressorBits>(real * v);
      w = on_grid<kOffsetBits>(real * w);
      const V terms[kTerms] = {real, v, t, v * v, t * t, w};
      for (int a = 0; a < kTerms; ++a) {
        for (int b = 0; b <= a; ++b) sums[a][b] = simd::exact_multiply_add(terms[a], terms[b], sums[a][b]);
      }
    }
    for (int a = 0; a < kTerms; ++a) {
      for (int b = 0; b <= a; ++b) out[a][b] = simd::exact_lane_sum(sums[a][b]);
    }
  }
};

}  // namespace

double curved_surface_rms(const BallPoints& points, const FoldLine& line) {
  const Vector3 across = cross(line.direction, line.opening);
  double products[kTerms][kTerms] = {};
  simd::dispatch<SumProducts>(points, line, across, products);
  double m[kUnknowns][kUnknowns] = {};
  double y[kUnknowns];
  for (int a = 0; a < kUnknowns; ++a) {
    for (int b = 0; b <= a; ++b) m[a][b] = products[a][b];
    y[a] = products[kUnknowns][a];
  }
  double x[kUnknowns] = {};
  double variance = 0.0;
  if (!solve_normal_equations<kUnknowns>(m, y, kUnknowns, x, variance)) return std::numeric_limits<double>::infinity();
  double squares = products[kUnknowns][kUnknowns];
  for (int a = 0; a < kUnknowns; ++a) squares -= x[a] * y[a];
  // The arms rise along w by the cotangent of half the angle: the sine of it turns w into distance.
  const double sine = std::sqrt(std::max(line.sine2_half, 0.0));
  return sine * std::sqrt(std::max(squares, 0.0) / static_cast<double>(points.count));
}

}  // namespace arris
