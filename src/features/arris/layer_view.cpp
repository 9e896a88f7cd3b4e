#include "features/arris/layer_view.h"

#include <bit>

#include "features/numerics/exact_sums.h"

namespace arris {
namespace {

/// Azimuths fall into 32 bins of the pseudo-angle v / (|u| + |v|), 8 per quadrant. A quarter turn is 8 bins wherever it
/// begins, and what 105 degrees have beyond it is more than one bin: such a gap leaves 8 bins in a row empty.
constexpr double kBinsPerQuadrant = 8.0;
/// Points without azimuth go here, which is none of the 32.
constexpr double kNoBin = 40.0;
/// Shifts every bin out.
constexpr double kShiftOut = 63.0;

bool has_empty_quarter(std::uint32_t occupied) {
  std::uint32_t empty = ~occupied;
  empty &= std::rotl(empty, 1);
  empty &= std::rotl(empty, 2);
  empty &= std::rotl(empty, 4);
  return empty != 0;
}

/// Largest whole number at most v, in [0, 2^50), in the low bits.
template <class V>
ARRIS_ALWAYS_INLINE auto whole(const V& v) {
  constexpr double kTwoTo52 = 4503599627370496.0;
  const V nearest = on_grid<0>(v);
  return simd::bits(nearest - simd::where_above(nearest, v) + kTwoTo52) & 0xff;
}

/// Bit of the azimuth's bin; `has` is 1 for points with azimuth, else 0.
template <class V>
ARRIS_ALWAYS_INLINE auto azimuth_bit(const V& u, const V& v, const V& has) {
  typedef typename simd::Wide<sizeof(V)>::Unsigned Bits;
  const V share = kBinsPerQuadrant * simd::magnitude(v) / (simd::magnitude(u) + simd::magnitude(v) + (1.0 - has));
  const V above = u >= 0.0 ? share : 16.0 - share;
  const V below = u < 0.0 ? 16.0 + share : 32.0 - share;
  const V turned = v >= 0.0 ? above : below;
  const Bits bin = (Bits)whole(turned * has) & 31U;
  const Bits none = (Bits)whole((1.0 - has) * kNoBin);
  const Bits one = Bits{} + 1U;
  return one << (bin | none);
}

struct Look {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const BallPoints& p, double radius2, const FittedPlane& plane, double gate,
                                      LayerView& view) {
    using V = typename simd::Wide<Bytes>::Double;
    typename simd::Wide<Bytes>::Unsigned occupied{}, occupied_near{};
    V count{}, inner{}, beyond{}, azimuths{};
    for (std::size_t i = 0; i < p.padded_count(); i += Bytes / sizeof(double)) {
      const V x = simd::load<V>(p.x.data() + i), y = simd::load<V>(p.y.data() + i), z = simd::load<V>(p.z.data() + i);
      const V in = simd::where_at_most(x * x + y * y + z * z, radius2);
      const V off = simd::magnitude(plane.normal[0] * x + plane.normal[1] * y + plane.normal[2] * z - plane.offset);
      const V of_layer = in * simd::where_at_most(off, gate);
      count += of_layer;
      inner += of_layer * simd::where_at_most(off, 0.5 * gate);
      beyond += (in - of_layer) * simd::where_at_most(off, 2.0 * gate);
      const V u = plane.e1[0] * x + plane.e1[1] * y + plane.e1[2] * z;
      const V v = plane.e2[0] * x + plane.e2[1] * y + plane.e2[2] * z;
      const V reach2 = u * u + v * v;
      const V has = of_layer * simd::where_above(reach2, kLeastOffset * kLeastOffset);
      azimuths += has;
      const auto bit = azimuth_bit(u, v, has);
      occupied |= bit;
      const V near = simd::where_at_most(reach2, kNearDisc * kNearDisc);
      occupied_near |= bit >> (typename simd::Wide<Bytes>::Unsigned)whole((1.0 - near) * kShiftOut);
      simd::store(view.u.data() + i, u);
      simd::store(view.v.data() + i, v);
      simd::store(view.reach2.data() + i, of_layer * reach2 - (1.0 - of_layer));
    }
    const V counts[] = {count, inner, beyond, azimuths};
    const std::array<double, 4> totals = simd::exact_lane_sums(counts);
    view.count = totals[0];
    view.inner = totals[1];
    view.beyond = totals[2];
    view.azimuths = totals[3];
    std::uint64_t all = 0;
    std::uint64_t near = 0;
    for (std::size_t lane = 0; lane < Bytes / sizeof(double); ++lane) {
      all |= occupied[lane];
      near |= occupied_near[lane];
    }
    view.may_have_gap =
        has_empty_quarter(static_cast<std::uint32_t>(all)) || has_empty_quarter(static_cast<std::uint32_t>(near));
  }
};

}  // namespace

void look_at_layer(const BallPoints& points, double radius, const FittedPlane& plane, double gate, LayerView& view) {
  for (auto* column : {&view.u, &view.v, &view.reach2}) {
    if (column->size() < points.padded_count()) column->resize(points.padded_count());
  }
  view.points = points.count;
  simd::dispatch<Look>(points, radius * radius, plane, gate, view);
}

}  // namespace arris
