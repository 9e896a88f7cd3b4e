#include "evaluate/segment_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace arris::evaluate {

namespace {

constexpr std::size_t kLeastPoints = 3;

/// xx, yy, zz, xy, xz, yz.
using Symmetric = std::array<double, 6>;

/// The two largest eigenvalues, by the trigonometric solution of the characteristic cubic (Smith 1961).
std::array<double, 2> largest_eigenvalues(const Symmetric& m) {
  const double mean = (m[0] + m[1] + m[2]) / 3.0;
  const double x = m[0] - mean, y = m[1] - mean, z = m[2] - mean;
  const double p = std::sqrt((x * x + y * y + z * z + 2.0 * (m[3] * m[3] + m[4] * m[4] + m[5] * m[5])) / 6.0);
  if (!(p > 0.0)) return {mean, mean};
  const double determinant =
      x * (y * z - m[5] * m[5]) - m[3] * (m[3] * z - m[5] * m[4]) + m[4] * (m[3] * m[5] - y * m[4]);
  const double angle = std::acos(std::clamp(determinant / (2.0 * p * p * p), -1.0, 1.0)) / 3.0;
  const double largest = mean + 2.0 * p * std::cos(angle);
  const double smallest = mean + 2.0 * p * std::cos(angle + 2.0 * std::numbers::pi / 3.0);
  return {largest, 3.0 * mean - largest - smallest};
}

/// Ratio of the half-axes; negative if there is none.
double roundness(std::span<const LabelledPoint> points, std::span<const std::uint64_t> members) {
  const auto position = [&](std::uint64_t key) { return points[static_cast<std::uint32_t>(key)].position; };
  if (members.size() < kLeastPoints) return -1.0;
  const Vec3 origin = position(members[0]);  // Keeps the digits of coordinates far from zero.
  const double count = static_cast<double>(members.size());
  Vec3 sum;
  for (const std::uint64_t key : members) sum = sum + (position(key) - origin);
  const Vec3 mean = (1.0 / count) * sum;
  Symmetric moments{};
  for (const std::uint64_t key : members) {
    const Vec3 d = position(key) - origin - mean;
    moments[0] += d.x * d.x;
    moments[1] += d.y * d.y;
    moments[2] += d.z * d.z;
    moments[3] += d.x * d.y;
    moments[4] += d.x * d.z;
    moments[5] += d.y * d.z;
  }
  const auto [first, second] = largest_eigenvalues(moments);
  return first > 0.0 ? std::sqrt(std::clamp(second / first, 0.0, 1.0)) : -1.0;
}

}  // namespace

std::optional<double> mean_compactness(std::span<const LabelledPoint> points) {
  std::vector<std::uint64_t> keys;  // Segment, then point.
  keys.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_judged(points[i]) && points[i].segment != 0) keys.push_back(std::uint64_t{points[i].segment} << 32 | i);
  }
  std::sort(keys.begin(), keys.end());
  double sum = 0.0, weight = 0.0;
  for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
    while (end < keys.size() && keys[end] >> 32 == keys[begin] >> 32) ++end;
    const double ratio = roundness(points, std::span(keys).subspan(begin, end - begin));
    if (ratio < 0.0) continue;
    sum += ratio * static_cast<double>(end - begin);
    weight += static_cast<double>(end - begin);
  }
  if (weight == 0.0) return std::nullopt;
  return sum / weight;
}

}  // namespace arris::evaluate
