#include "features/arris/quadric_share.h"

#include <algorithm>

#include "features/numerics/exact_sums.h"

namespace arris {
namespace {

constexpr std::size_t kAtOnce = simd::kWidestBytes / sizeof(double);
constexpr int kRegressorBits = 5;
constexpr int kOffsetBits = 10;
constexpr int kUnknowns = 6;  // Of 1, u, v, u², uv, v².
constexpr double kLeastDegrees = 3.0;
constexpr double kDependent = 1e-9;

/// Sums of u^a v^b, and of w times those up to the second degree; in the order in which products() fills them.
constexpr int kPowers = 15;
constexpr int kSums = kPowers + kUnknowns + 1;
/// Degrees of (u, v) of the sum of powers that is the product of two regressors.
constexpr int kProductOf[kUnknowns][kUnknowns] = {{0, 1, 2, 3, 4, 5},    {1, 3, 4, 6, 7, 8},    {2, 4, 5, 7, 8, 9},
                                                  {3, 6, 7, 10, 11, 12}, {4, 7, 8, 11, 12, 13}, {5, 8, 9, 12, 13, 14}};

/// Of several balls side by side.
struct Columns {
  double sums[kSums][kAtOnce];
  double shares[kAtOnce];
};

struct SumProducts {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const BallPoints& p, double radius2, const FittedPlane& plane, Columns& columns,
                                      std::size_t lane) {
    using V = typename simd::Wide<Bytes>::Double;
    V sums[kSums]{};
    for (std::size_t i = 0; i < p.padded_count(); i += Bytes / sizeof(double)) {
      const V x = simd::load<V>(p.x.data() + i), y = simd::load<V>(p.y.data() + i), z = simd::load<V>(p.z.data() + i);
      const V in = simd::where_at_most(x * x + y * y + z * z, radius2);
      const V u = on_grid<kRegressorBits>(in * (plane.e1[0] * x + plane.e1[1] * y + plane.e1[2] * z));
      const V v = on_grid<kRegressorBits>(in * (plane.e2[0] * x + plane.e2[1] * y + plane.e2[2] * z));
      const V w =
          on_grid<kOffsetBits>(in * (plane.normal[0] * x + plane.normal[1] * y + plane.normal[2] * z - plane.offset));
      const V uu = u * u, uv = u * v, vv = v * v;
      const V terms[] = {in, u, v, uu, uv, vv};
      ARRIS_UNROLL
      for (int k = 0; k < kUnknowns; ++k) {
        sums[k] += terms[k];
        sums[kPowers + k] = simd::exact_multiply_add(w, terms[k], sums[kPowers + k]);  // w is 0 beyond the radius.
      }
      const V factors[][2] = {{uu, u}, {uu, v}, {u, vv}, {vv, v}, {uu, uu}, {uu, uv}, {uu, vv}, {uv, vv}, {vv, vv}};
      ARRIS_UNROLL
      for (int k = 0; k < kPowers - kUnknowns; ++k) {
        sums[kUnknowns + k] = simd::exact_multiply_add(factors[k][0], factors[k][1], sums[kUnknowns + k]);
      }
      sums[kSums - 1] = simd::exact_multiply_add(w, w, sums[kSums - 1]);
    }
    const std::array<double, kSums> totals = simd::exact_lane_sums(sums);
    for (int k = 0; k < kSums; ++k) columns.sums[k][lane] = totals[static_cast<std::size_t>(k)];
  }
};

/// Least squares by Cholesky's method, ball by ball in the lanes: what solve_normal_equations() computes.
struct Shares {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(Columns& columns, std::size_t count) {
    using V = typename simd::Wide<Bytes>::Double;
    for (std::size_t lane = 0; lane < count; lane += Bytes / sizeof(double)) {
      V sums[kSums];
      for (int k = 0; k < kSums; ++k) sums[k] = simd::load<V>(columns.sums[k] + lane);
      simd::store(columns.shares + lane, share_of(sums));
    }
  }

 private:
  template <class V>
  static ARRIS_ALWAYS_INLINE V share_of(const V (&sums)[kSums]) {
    const V zero{};
    const V one = zero + 1.0;
    const V n = sums[0];
    const V flat = sums[kSums - 1];
    V determined = simd::where_above(n, kUnknowns + 2.0) * simd::where_above(flat, 0.0);
    V l[kUnknowns][kUnknowns];
    V z[kUnknowns], x[kUnknowns];
    for (int i = 0; i < kUnknowns; ++i) {
      for (int j = 0; j <= i; ++j) {
        V sum = sums[kProductOf[i][j]];
        for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
        if (i != j) {
          l[i][j] = sum / l[j][j];
          continue;
        }
        const auto apart = sum > kDependent * sums[kProductOf[i][i]];
        determined = apart ? determined : zero;
        l[i][i] = simd::square_root(apart ? sum : one);  // Any number: the share is not taken from it.
      }
    }
    for (int i = 0; i < kUnknowns; ++i) {
      V sum = sums[kPowers + i];
      for (int k = 0; k < i; ++k) sum -= l[i][k] * z[k];
      z[i] = sum / l[i][i];
    }
    for (int i = kUnknowns - 1; i >= 0; --i) {
      V sum = z[i];
      for (int k = i + 1; k < kUnknowns; ++k) sum -= l[k][i] * x[k];
      x[i] = sum / l[i][i];
    }
    V bent = flat;
    for (int i = 0; i < kUnknowns; ++i) bent -= x[i] * sums[kPowers + i];
    bent = bent > 0.0 ? bent : zero;
    const V share = simd::square_root(bent / (n - kUnknowns) / (flat / (n - kLeastDegrees)));
    return determined > 0.0 ? share : one;
  }
};

}  // namespace

void quadric_shares(std::span<const BallPoints* const> balls, double radius, std::span<const FittedPlane> planes,
                    std::span<double> shares) {
  Columns columns{};
  for (std::size_t first = 0; first < balls.size(); first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, balls.size() - first);
    for (std::size_t lane = 0; lane < count; ++lane) {
      simd::dispatch<SumProducts>(*balls[first + lane], radius * radius, planes[first + lane], columns, lane);
    }
    simd::dispatch_for<Shares>(count, columns, count);
    std::copy_n(columns.shares, count, shares.data() + first);
  }
}

}  // namespace arris
