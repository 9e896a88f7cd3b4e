#include "features/liu/scale_batch.h"

#include <algorithm>
#include <limits>

#include "features/numerics/transpose.h"

namespace arris {
namespace {

/// Moments of growing neighbourhoods, one per lane, added up in canonical order.
template <class V>
struct Moments {
  V x{}, y{}, z{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};

  ARRIS_ALWAYS_INLINE void add(const V& dx, const V& dy, const V& dz) {
    x += dx;
    y += dy;
    z += dz;
    xx += dx * dx;
    xy += dx * dy;
    xz += dx * dz;
    yy += dy * dy;
    yz += dy * dz;
    zz += dz * dz;
  }
  ARRIS_ALWAYS_INLINE SymmetricMatrix<V> scaled_covariance(double n) const {
    return {n * xx - x * x, n * xy - x * y, n * xz - x * z, n * yy - y * y, n * yz - y * z, n * zz - z * z};
  }
};

/// The running minimum of the entropy over ascending k, per lane.
template <class V>
struct Best {
  V entropy = V{} + std::numeric_limits<double>::infinity();
  V k{};
  SymmetricMatrix<V> covariance{};
  Eigenvalues<V> values{};

  template <class Mask>
  ARRIS_ALWAYS_INLINE void replace(const Mask& where, const Best& by) {
    entropy = where ? by.entropy : entropy;
    k = where ? by.k : k;
    covariance.xx = where ? by.covariance.xx : covariance.xx;
    covariance.xy = where ? by.covariance.xy : covariance.xy;
    covariance.xz = where ? by.covariance.xz : covariance.xz;
    covariance.yy = where ? by.covariance.yy : covariance.yy;
    covariance.yz = where ? by.covariance.yz : covariance.yz;
    covariance.zz = where ? by.covariance.zz : covariance.zz;
    values.largest = where ? by.values.largest : values.largest;
    values.middle = where ? by.values.middle : values.middle;
    values.smallest = where ? by.values.smallest : values.smallest;
  }
  /// @param limit  the entropy of `other`, infinite in lanes that it is no choice for.
  ARRIS_ALWAYS_INLINE void offer(const V& limit, const Best& other) { replace(limit < entropy - kEntropyTie, other); }
};

}  // namespace

struct ScaleBatch::Kernel {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(ScaleBatch& batch) {
    transpose_rows<Bytes>(batch);
    choose<Bytes>(batch);
  }

 private:
  /// To columns of the j-th neighbours of all queries.
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void transpose_rows(ScaleBatch& batch) {
    using V = typename simd::Wide<Bytes>::Double;
    constexpr std::size_t kLanes = Bytes / sizeof(double);
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t query = 0; query < kCount; query += kLanes) {
        for (std::size_t first = 0; first < batch.offsets_.size(); first += kLanes) {
          V rows[kLanes];
          ARRIS_UNROLL
          for (std::size_t i = 0; i < kLanes; ++i) rows[i] = simd::load<V>(batch.rows_[query + i][axis] + first);
          simd::transpose<kLanes>(rows);
          ARRIS_UNROLL
          for (std::size_t j = 0; j < kLanes; ++j) simd::store(batch.offsets_[first + j][axis].data() + query, rows[j]);
        }
      }
    }
  }

  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void choose(ScaleBatch& batch) {
    using V = typename simd::Wide<Bytes>::Double;
    const ScaleRange& range = batch.range_;
    const V never = V{} + std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < kCount; i += Bytes / sizeof(double)) {
      const auto count = simd::load<V>(batch.count_.data() + i);
      Moments<V> moments;
      Best<V> planar, any;
      std::size_t added = 0;
      for (int k = range.k_min; k <= range.k_max; k += range.k_step) {
        for (; added < static_cast<std::size_t>(k); ++added) {
          const Offset& offset = batch.offsets_[added];
          moments.add(simd::load<V>(offset[0].data() + i), simd::load<V>(offset[1].data() + i),
                      simd::load<V>(offset[2].data() + i));
        }
        Best<V> now;
        now.k = V{} + static_cast<double>(k);
        now.covariance = moments.scaled_covariance(k + (range.with_target ? 1 : 0));
        now.values = eigenvalues_of(now.covariance);
        now.entropy = entropy_of(now.values);
        const V entropy = count >= now.k ? now.entropy : never;
        any.offer(entropy, now);
        planar.offer(now.values.middle >= range.min_planarity * now.values.largest ? entropy : never, now);
      }
      any.replace(planar.k > 0.0, planar);
      Choices& out = batch.choices_;
      simd::store(out.k.data() + i, any.k);
      simd::store(out.xx.data() + i, any.covariance.xx);
      simd::store(out.xy.data() + i, any.covariance.xy);
      simd::store(out.xz.data() + i, any.covariance.xz);
      simd::store(out.yy.data() + i, any.covariance.yy);
      simd::store(out.yz.data() + i, any.covariance.yz);
      simd::store(out.zz.data() + i, any.covariance.zz);
      simd::store(out.largest.data() + i, any.values.largest);
      simd::store(out.middle.data() + i, any.values.middle);
      simd::store(out.smallest.data() + i, any.values.smallest);
    }
  }
};

ScaleBatch::ScaleBatch(const ScaleRange& range)
    : range_(range),
      offsets_(simd::padded(static_cast<std::size_t>(std::max(range.k_max, 0)))),
      nothing_(offsets_.size()) {
  for (auto& row : rows_) row.fill(nothing_.data());
}

void ScaleBatch::set(std::size_t i, const Neighbours& neighbours) {
  rows_[i] = {neighbours.dx.data(), neighbours.dy.data(), neighbours.dz.data()};
  count_[i] = static_cast<double>(neighbours.count);
}

void ScaleBatch::solve() {
  simd::dispatch<Kernel>(*this);
  for (auto& row : rows_) row.fill(nothing_.data());
}

ScaleChoice ScaleBatch::choice(std::size_t i) const {
  const Choices& c = choices_;
  return {static_cast<int>(c.k[i]),
          {c.xx[i], c.xy[i], c.xz[i], c.yy[i], c.yz[i], c.zz[i]},
          {c.largest[i], c.middle[i], c.smallest[i]}};
}

}  // namespace arris
