#include "features/segment/robust_plane.h"

#include "features/numerics/exact_math.h"
#include "features/segment/weighted_plane.h"

namespace arris {
namespace {

using detail::LanePlane;

/// Rounds of weights that are not as published.
constexpr int kWeightRounds = 3;
/// Standard deviation of a normal distribution over its median absolute deviation, times 2.5 of them.
constexpr double kMedianToLimit = 2.5 * 1.4826;

template <class V>
ARRIS_ALWAYS_INLINE V magnitude(const V& v) {
  return v < 0.0 ? -v : v;
}

template <class V>
ARRIS_ALWAYS_INLINE void put(const LanePlane<V>& plane, const NeighbourhoodBatch& batch, std::size_t lane,
                             PlaneBatch& planes) {
  simd::store(planes.nx.data() + lane, plane.nx);
  simd::store(planes.ny.data() + lane, plane.ny);
  simd::store(planes.nz.data() + lane, plane.nz);
  simd::store(planes.variation.data() + lane, plane.variation);
  simd::store(planes.width.data() + lane, plane.width);
  const V zero = plane.nx - plane.nx;
  V farthest = magnitude<V>(plane.distance(zero, zero, zero));
  for (std::size_t i = 0; i < batch.neighbours; ++i) {
    const V d =
        magnitude<V>(plane.distance(simd::load<V>(batch.x[i].data() + lane), simd::load<V>(batch.y[i].data() + lane),
                                    simd::load<V>(batch.z[i].data() + lane)));
    farthest = d > farthest ? d : farthest;
  }
  simd::store(planes.farthest.data() + lane, farthest / simd::load<V>(batch.mean_distance.data() + lane));
}

struct PlainPlanes {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const NeighbourhoodBatch& batch, PlaneBatch& planes) {
    using V = typename simd::Wide<Bytes>::Double;
    const V one = V{} + 1.0;
    for (std::size_t lane = 0; lane < kBatchLanes; lane += Bytes / sizeof(double)) {
      const LanePlane<V> plane = detail::weighted_plane<V>(batch, lane, one, [&](std::size_t) { return one; });
      put(plane, batch, lane, planes);
    }
  }
};

/// Start planes of all lanes, in steps.
struct MedianStarts {
  NeighbourhoodBatch::Row nx{}, ny{}, nz{}, px{}, py{}, pz{}, median{};
};

struct MedianPlanes {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const NeighbourhoodBatch& batch, const MedianPlan& plan, MedianStarts& starts) {
    static_assert(kMostNeighbours == 64);
    if (batch.neighbours <= 8) return run_up_to<8, Bytes>(batch, plan, starts);
    if (batch.neighbours <= 16) return run_up_to<16, Bytes>(batch, plan, starts);
    if (batch.neighbours <= 32) return run_up_to<32, Bytes>(batch, plan, starts);
    run_up_to<64, Bytes>(batch, plan, starts);
  }

 private:
  template <std::size_t N, int Bytes>
  static ARRIS_ALWAYS_INLINE void run_up_to(const NeighbourhoodBatch& batch, const MedianPlan& plan,
                                            MedianStarts& starts) {
    using F = typename simd::Wide<Bytes>::Float;
    constexpr std::size_t kLanes = Bytes / sizeof(float);
    detail::MedianPoints<F, N> points;
    for (std::size_t lane = 0; lane < kBatchLanes; lane += kLanes) {
      for (std::size_t i = 0; i < batch.neighbours; ++i) {
        for (std::size_t k = 0; k < kLanes; ++k) {
          const double unit = 1.0 / batch.mean_distance[lane + k];
          points.x[i][k] = static_cast<float>(batch.x[i][lane + k] * unit);
          points.y[i][k] = static_cast<float>(batch.y[i][lane + k] * unit);
          points.z[i][k] = static_cast<float>(batch.z[i][lane + k] * unit);
        }
      }
      const detail::MedianPlane<F> plane = detail::median_plane<F, N>(plan, batch.neighbours, points);
      for (std::size_t k = 0; k < kLanes; ++k) {
        const double unit = batch.mean_distance[lane + k];
        starts.nx[lane + k] = plane.nx[k];
        starts.ny[lane + k] = plane.ny[k];
        starts.nz[lane + k] = plane.nz[k];
        starts.px[lane + k] = plane.px[k] * unit;
        starts.py[lane + k] = plane.py[k] * unit;
        starts.pz[lane + k] = plane.pz[k] * unit;
        starts.median[lane + k] = plane.median[k] * unit;
      }
    }
  }
};

struct WeightedPlanes {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const NeighbourhoodBatch& batch, const MedianStarts& starts,
                                      const PlaneWeights& settings, PlaneBatch& planes) {
    using V = typename simd::Wide<Bytes>::Double;
    for (std::size_t lane = 0; lane < kBatchLanes; lane += Bytes / sizeof(double)) {
      const auto start = [&](const NeighbourhoodBatch::Row& row) { return simd::load<V>(row.data() + lane); };
      const V zero{};
      LanePlane<V> plane{start(starts.nx),
                         start(starts.ny),
                         start(starts.nz),
                         start(starts.px),
                         start(starts.py),
                         start(starts.pz),
                         zero,
                         zero};
      const V mu = start(batch.mean_distance);
      const V inverse_mu2 = 1.0 / (mu * mu);
      const V by_median = kMedianToLimit * start(starts.median), least = kInlierShare * mu;
      const V limit = settings.inlier_steps > 0.0 ? zero + settings.inlier_steps
                      : by_median > least         ? by_median
                                                  : least;
      const V decay = settings.published ? inverse_mu2 : 1.0 / (limit * limit);
      const double lead = settings.published ? 0.0 : 1.0;
      for (int round = 0; round < (settings.published ? 1 : kWeightRounds); ++round) {
        const LanePlane<V> before = plane;
        const auto weight_at = [&](const V& x, const V& y, const V& z) {
          const V d = before.distance(x, y, z);
          const V d2 = d * d;
          return d2 > limit * limit ? exponential_decay<V>(d2 * decay - lead) : zero + 1.0;
        };
        V weights[kMostNeighbours];
        for (std::size_t i = 0; i < batch.neighbours; ++i)
          weights[i] = weight_at(start(batch.x[i]), start(batch.y[i]), start(batch.z[i]));
        plane = detail::weighted_plane<V>(batch, lane, weight_at(zero, zero, zero),
                                          [&](std::size_t i) { return weights[i]; });
      }
      put(plane, batch, lane, planes);
    }
  }
};

}  // namespace

void fit_plain_planes(const NeighbourhoodBatch& batch, PlaneBatch& planes) {
  simd::dispatch<PlainPlanes>(batch, planes);
}

void fit_robust_planes(const NeighbourhoodBatch& batch, const MedianPlan& plan, const PlaneWeights& weights,
                       PlaneBatch& planes) {
  MedianStarts starts;
  simd::dispatch<MedianPlanes>(batch, plan, starts);
  simd::dispatch<WeightedPlanes>(batch, starts, weights, planes);
}

}  // namespace arris
