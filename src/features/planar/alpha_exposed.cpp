#include "features/planar/alpha_exposed.h"

#include <algorithm>
#include <cmath>

#include "features/numerics/exact_math.h"
#include "features/numerics/simd.h"

namespace arris {
namespace {

constexpr int kBins = 16;
/// By so much a direction must be blocked to count in float arithmetic, whose errors are below 1e-6 here.
constexpr float kBlockMargin = 1e-5F;
constexpr double kCoincident = 1e-9;

/// Borders of the bins, twice round, so that the next one is a step away.
struct BinBorders {
  float x[2 * kBins], y[2 * kBins];
  constexpr BinBorders() : x{}, y{} {
    constexpr double kCosine[] = {1.0, 0.92387953251128675613, 0.70710678118654752440, 0.38268343236508977173, 0.0};
    const auto cosine = [&](int i) {
      i %= kBins;
      if (i > kBins / 2) i = kBins - i;
      return i <= kBins / 4 ? kCosine[i] : -kCosine[kBins / 2 - i];
    };
    for (int i = 0; i < 2 * kBins; ++i) {
      x[i] = static_cast<float>(cosine(i));
      y[i] = static_cast<float>(cosine(i + 3 * kBins / 4));
    }
  }
};
constexpr BinBorders kBorders;

/// Whether single neighbours block each of the bins from end to end. A neighbour q (units of 2 alpha) blocks the
/// direction u if q . u > |q|²; what it blocks is narrower than a half turn, so both ends of a bin suffice.
struct AllBinsBlocked {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const PlaneNeighbours& neighbours, bool& all) {
    using V = typename simd::Wide<Bytes>::Float;
    constexpr int kLanes = Bytes / sizeof(float);
    constexpr int kVectors = kBins / kLanes;
    constexpr std::size_t kRound = 8;
    V margin[kVectors];
    for (int k = 0; k < kVectors; ++k) margin[k] = V{} - 1.0F;
    for (std::size_t begin = 0; begin < neighbours.count; begin += kRound) {
      const std::size_t end = std::min(begin + kRound, neighbours.count);
      for (std::size_t i = begin; i < end; ++i) {
        const auto a = static_cast<float>(neighbours.a[i]);
        const auto b = static_cast<float>(neighbours.b[i]);
        const float d2 = a * a + b * b;
        for (int k = 0; k < kVectors; ++k) {
          const V here = a * simd::load<V>(kBorders.x + k * kLanes) + b * simd::load<V>(kBorders.y + k * kLanes) - d2;
          const V next =
              a * simd::load<V>(kBorders.x + k * kLanes + 1) + b * simd::load<V>(kBorders.y + k * kLanes + 1) - d2;
          const V least = here < next ? here : next;
          margin[k] = margin[k] > least ? margin[k] : least;
        }
      }
      all = true;
      for (int k = 0; k < kVectors; ++k) {
        for (int lane = 0; lane < kLanes; ++lane) all &= margin[k][lane] > kBlockMargin;
      }
      if (all) return;
    }
  }
};

}  // namespace

bool AlphaExposure::surely_blocked(const PlaneNeighbours& neighbours) const {
  bool all = false;
  simd::dispatch<AllBinsBlocked>(neighbours, all);
  return all;
}

double AlphaExposure::operator()(const PlaneNeighbours& neighbours) {
  return surely_blocked(neighbours) ? 0.0 : without_rejection(neighbours);
}

double AlphaExposure::without_rejection(const PlaneNeighbours& neighbours) {
  blocked_.clear();
  for (std::size_t i = 0; i < neighbours.count; ++i) {
    const double a = neighbours.a[i];
    const double b = neighbours.b[i];
    const double d2 = a * a + b * b;
    if (d2 >= 1.0 || d2 <= kCoincident * kCoincident) continue;
    const double middle = angle_of(b, a);
    const double half = arc_cosine(std::sqrt(d2));
    double start = middle - half;
    if (start < -kPi) start += 2.0 * kPi;
    blocked_.emplace_back(start, start + 2.0 * half);
  }
  if (blocked_.empty()) return 360.0;
  std::sort(blocked_.begin(), blocked_.end());
  const double first = blocked_[0].first;
  double covered = first;
  // What runs past the end of the turn blocks its beginning.
  for (const auto& [start, end] : blocked_) covered = std::max(covered, end - 2.0 * kPi);
  double widest = 0.0;
  for (const auto& [start, end] : blocked_) {
    widest = std::max(widest, start - covered);
    covered = std::max(covered, end);
  }
  widest = std::max(widest, first + 2.0 * kPi - covered);
  const double width_deg = widest * kDegreesPerRadian;
  return width_deg > kTouch_deg ? width_deg : 0.0;
}

}  // namespace arris
