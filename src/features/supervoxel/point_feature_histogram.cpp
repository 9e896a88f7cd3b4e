#include "features/supervoxel/point_feature_histogram.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace arris {
namespace {

constexpr std::size_t kGrain = 4 * 1024;
constexpr int kBins = 11;
constexpr float kPi = 3.14159265358979323846F;
/// Below this |d x u| the line counts as parallel to the normal.
constexpr float kParallel = 1e-6F;

using Float3 = std::array<float, 3>;
/// Counts of one voxel's pairs; at most 26 per histogram.
struct Simplified {
  std::array<std::uint8_t, kHistogramBins> counts{};
  std::uint8_t pairs = 0;
};

float dot(const Float3& a, const Float3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Float3 cross(const Float3& a, const Float3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
bool defined(const Float3& n) {
  return n[0] != 0.0F || n[1] != 0.0F || n[2] != 0.0F;
}

std::size_t bin(float value_0_to_1) {
  const int b = static_cast<int>(std::floor(static_cast<float>(kBins) * value_0_to_1));
  return static_cast<std::size_t>(std::clamp(b, 0, kBins - 1));
}

Float3 offset(const VoxelTile& tile, std::size_t from, std::size_t to) {
  Float3 d;
  for (std::size_t axis = 0; axis < 3; ++axis)
    d[axis] = static_cast<float>(difference(tile.positions[to][axis], tile.positions[from][axis]));
  return d;
}

Simplified simplified_histogram(const VoxelTile& tile, std::span<const Float3> normals, std::size_t v) {
  Simplified result;
  if (!defined(normals[v])) return result;
  for (const std::uint32_t u : tile.neighbours_of(v)) {
    PairFeatures f{};
    if (!defined(normals[u]) || !pair_features(offset(tile, v, u), normals[v], normals[u], f)) continue;
    ++result.counts[bin(0.5F * (f.alpha + 1.0F))];
    ++result.counts[kBins + bin(0.5F * (f.phi + 1.0F))];
    ++result.counts[2 * kBins + bin((f.theta + kPi) / (2.0F * kPi))];
    ++result.pairs;
  }
  return result;
}

void add(std::array<float, kHistogramBins>& to, const Simplified& s, float weight) {
  if (s.pairs == 0) return;
  const float each = weight / static_cast<float>(s.pairs);
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += each * static_cast<float>(s.counts[i]);
}

FeatureHistogram quantised(const std::array<float, kHistogramBins>& sums) {
  FeatureHistogram histogram{};
  for (std::size_t part = 0; part < 3; ++part) {
    float total = 0.0F;
    for (std::size_t i = 0; i < kBins; ++i) total += sums[part * kBins + i];
    if (!(total > 0.0F)) continue;
    const float scale = static_cast<float>(kHistogramTotal / 3) / total;
    for (std::size_t i = 0; i < kBins; ++i)
      histogram[part * kBins + i] = static_cast<std::int16_t>(sums[part * kBins + i] * scale + 0.5F);
  }
  return histogram;
}

}  // namespace

bool pair_features(const Float3& d, const Float3& n1, const Float3& n2, PairFeatures& out) {
  const float length = std::sqrt(dot(d, d));
  if (!(length > 0.0F)) return false;
  Float3 line{d[0] / length, d[1] / length, d[2] / length};
  Float3 u = n1;
  Float3 other = n2;
  float along = dot(n1, line);
  const float along2 = dot(n2, line);
  if (std::abs(along) < std::abs(along2)) {  // The second point becomes the source.
    u = n2;
    other = n1;
    line = {-line[0], -line[1], -line[2]};
    along = -along2;
  }
  Float3 v = cross(line, u);
  const float sine = std::sqrt(dot(v, v));
  if (!(sine > kParallel)) return false;
  v = {v[0] / sine, v[1] / sine, v[2] / sine};
  const Float3 w = cross(u, v);
  out.alpha = dot(v, other);
  out.phi = along;
  out.theta = std::atan2(dot(w, other), dot(u, other));
  return true;
}

PageVector<FeatureHistogram> feature_histograms(const VoxelTile& tile, std::span<const Float3> normals) {
  PageVector<Simplified> simplified(tile.size());
  parallel_for_chunks(tile.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) simplified[v] = simplified_histogram(tile, normals, v);
  });
  const float side = static_cast<float>(kVoxelFractions) * static_cast<float>(tile.grid.side_steps());
  PageVector<FeatureHistogram> histograms(tile.size());
  parallel_for_chunks(tile.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      std::array<float, kHistogramBins> sums{};
      add(sums, simplified[v], 1.0F);
      const auto neighbours = tile.neighbours_of(v);
      for (const std::uint32_t u : neighbours) {
        const Float3 d = offset(tile, v, u);
        const float distance = std::sqrt(dot(d, d)) / side;
        if (distance > 0.0F) add(sums, simplified[u], 1.0F / (static_cast<float>(neighbours.size()) * distance));
      }
      histograms[v] = quantised(sums);
    }
  });
  return histograms;
}

}  // namespace arris
