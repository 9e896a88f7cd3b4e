#include "features/neighbourhood/azimuth_gap.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "features/numerics/exact_math.h"

namespace arris {
namespace {

constexpr int kBins = 64;

/// The bin of the diamond angle (a monotone stand-in for the azimuth, 4 per turn) of the first `count` neighbours; more
/// than kBins for those that might be too close for an azimuth.
struct DiamondBins {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const Neighbours& neighbours, const GapQuery& q, std::size_t count,
                                      std::int32_t* bins) {
    using V = typename simd::Wide<Bytes>::Double;
    constexpr std::size_t kLanes = Bytes / sizeof(double);
    const double skip = 2.0 * q.min_offset + 1e-9;
    for (std::size_t i = 0; i < count; i += kLanes) {
      const auto dx = simd::load<V>(neighbours.dx.data() + i);
      const auto dy = simd::load<V>(neighbours.dy.data() + i);
      const auto dz = simd::load<V>(neighbours.dz.data() + i);
      const V a = dx * q.u[0] + dy * q.u[1] + dz * q.u[2];
      const V b = dx * q.v[0] + dy * q.v[1] + dz * q.v[2];
      const V size = (a < 0.0 ? -a : a) + (b < 0.0 ? -b : b);
      const V ratio = a / (size > skip ? size : V{} + 1.0);
      const V diamond = b >= 0.0 ? 1.0 - ratio : 3.0 + ratio;
      const V bin = size > skip ? diamond * (kBins / 4.0) : V{} + 2.0 * kBins;
      for (std::size_t lane = 0; lane < kLanes; ++lane) bins[i + lane] = static_cast<std::int32_t>(bin[lane]);
    }
  }
};

/// One bit per bin that one of the first `count` <= 200 neighbours falls into.
std::uint64_t occupied_bins(const Neighbours& neighbours, const GapQuery& q, std::size_t count) {
  std::int32_t bins[simd::padded(200)];
  simd::dispatch<DiamondBins>(neighbours, q, count, bins);
  std::uint64_t occupied = 0;
  for (std::size_t i = 0; i < count; ++i) {
    // A turn may round to a full 64, which is bin 0.
    if (bins[i] <= kBins) occupied |= std::uint64_t{1} << (bins[i] % kBins);
  }
  return occupied;
}

/// True if `length` >= 1 bins in a row, going round, are empty.
bool has_empty_run(std::uint64_t occupied, int length) {
  std::uint64_t run = ~occupied;
  int have = 1;
  while (have < length && run != 0) {
    const int more = std::min(have, length - have);
    run &= std::rotr(run, more);
    have += more;
  }
  return run != 0;
}

/// Diamond angles that any gap of `deg` degrees spans at least: a quarter turn is exactly 1, and a smaller angle spans
/// least when a diagonal halves it.
double least_diamond_span(double deg) {
  const double quarters = std::floor(deg / 90.0);
  const double rest = (deg - 90.0 * quarters) / kDegreesPerRadian;
  const double below = kPi / 4 - rest / 2;
  return quarters + 1.0 - 2.0 * std::sin(below) / (std::sin(below) + std::cos(below));
}

using Entry = AzimuthGapTest::Entry;

std::vector<Entry>& sorted_azimuths(const Neighbours& neighbours, const GapQuery& q, std::vector<Entry>& entries) {
  entries.clear();
  for (std::size_t i = 0; i < q.count; ++i) {
    const Vector3 d{neighbours.dx[i], neighbours.dy[i], neighbours.dz[i]};
    const double a = dot(q.u, d);
    const double b = dot(q.v, d);
    if (a * a + b * b <= q.min_offset * q.min_offset) continue;
    entries.push_back({angle_of(b, a) * kDegreesPerRadian, i >= q.near_count});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.azimuth != b.azimuth ? a.azimuth < b.azimuth : a.far < b.far;
  });
  return entries;
}

/// Largest gap between consecutive entries, or between consecutive near entries. 0 for fewer than three.
double largest_gap(const std::vector<Entry>& entries, bool near_only) {
  std::size_t used = 0;
  double first = 0.0;
  double previous = 0.0;
  double gap = 0.0;
  for (const Entry& entry : entries) {
    if (near_only && entry.far) continue;
    if (used++ == 0) {
      first = entry.azimuth;
    } else {
      gap = std::max(gap, entry.azimuth - previous);
    }
    previous = entry.azimuth;
  }
  if (used < 3) return 0.0;
  return std::max(gap, 360.0 - previous + first);
}

/// Largest span from the first to the last entry of a run of far entries, going round.
double largest_far_span(const std::vector<Entry>& entries) {
  const std::size_t n = entries.size();
  if (n < 3) return 0.0;
  std::size_t start = 0;
  while (start < n && entries[start].far) ++start;
  if (start == n) return 360.0 - largest_gap(entries, false);
  double span = 0.0;
  double first = 0.0;
  bool inside = false;
  for (std::size_t step = 1; step < n; ++step) {
    const std::size_t i = (start + step) % n;
    const double azimuth = entries[i].azimuth + (i < start ? 360.0 : 0.0);
    if (entries[i].far && !inside) first = azimuth;
    inside = entries[i].far;
    if (inside) span = std::max(span, azimuth - first);
  }
  return span;
}

}  // namespace

AzimuthGapTest::AzimuthGapTest(double threshold_deg, GapSpan span) : threshold_deg_(threshold_deg), span_(span) {
  // The bins at both ends of a gap are partly covered, and rounding may move an end into the next one.
  constexpr double kSlack = 1e-3;
  empty_bins_ = static_cast<int>(std::floor((least_diamond_span(threshold_deg) - kSlack) * (kBins / 4.0))) - 1;
}

GapResult AzimuthGapTest::operator()(const Neighbours& neighbours, const GapQuery& query,
                                     std::vector<Entry>& scratch) const {
  if (empty_bins_ > 0 && query.count <= 200) {
    // Near neighbours without a wide gap reject every reading: all neighbours leave less of a gap, and an inner span of
    // far ones lies within a gap of near ones.
    const std::uint64_t occupied = occupied_bins(neighbours, query, std::min(query.near_count, query.count));
    if (!has_empty_run(occupied, empty_bins_)) return {};
  }
  return without_rejection(neighbours, query, scratch);
}

GapResult AzimuthGapTest::without_rejection(const Neighbours& neighbours, const GapQuery& query,
                                            std::vector<Entry>& scratch) const {
  const std::vector<Entry>& entries = sorted_azimuths(neighbours, query, scratch);
  const double threshold = threshold_deg_ - kGapTie_deg;
  GapResult result;
  const double gap = largest_gap(entries, false);
  if (gap >= threshold) {
    result.boundary_deg = gap;
  } else if (query.near_count < query.count) {
    const double span = span_ == GapSpan::kBracket ? largest_gap(entries, true) : largest_far_span(entries);
    if (span >= threshold) result.weak_deg = span;
  }
  return result;
}

}  // namespace arris
