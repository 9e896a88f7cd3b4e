#include "merge/supervoxel_moments.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "features/numerics/symmetric_eigen3.h"

namespace arris::merge {
namespace {

constexpr int kOffsetBits = 17;
constexpr double kPi = 3.14159265358979323846;
/// Points on a line define no plane: the second eigenvalue must be at least this share of the first.
constexpr double kLeastWidth = 1e-6;

}  // namespace

SupervoxelMoments::SupervoxelMoments(std::uint32_t count, std::int64_t reach_steps) : first_(std::size_t{count} + 1) {
  const auto bits =
      static_cast<int>(std::bit_width(static_cast<std::uint64_t>(std::max<std::int64_t>(reach_steps, 1))));
  shift_ = std::max(0, bits - kOffsetBits);
}

std::uint64_t SupervoxelMoments::most_bytes(std::uint64_t count, std::uint64_t points, std::uint64_t pairs) {
  const std::uint64_t of_several = std::min(count, points - std::min(points, count));  // None is empty.
  constexpr std::uint64_t kRowBytes = sizeof(std::array<float, 3>) + sizeof(std::array<double, 3>) + 2 * sizeof(float);
  // A row, and where its neighbours begin, twice while they are listed.
  return count * (sizeof(First) + kRowBytes + 2 * sizeof(std::uint32_t)) + of_several * sizeof(Sums) +
         2 * pairs * sizeof(std::uint32_t);
}

const SupervoxelMoments::Sums& SupervoxelMoments::sums_of(std::uint32_t id) const {
  static constexpr Sums kNone{}, kOne{1};
  const std::uint32_t sums = first_[id].sums;
  return sums == kNoPoint ? kNone : sums == kOnePoint ? kOne : sums_[sums];
}

std::uint64_t SupervoxelMoments::points(std::uint32_t id) const {
  return sums_of(id).points;
}

void SupervoxelMoments::add(std::uint32_t id, const LatticePoint& p) {
  First& first = first_[id];
  if (first.sums == kNoPoint) {  // Its offsets are 0.
    first = {p, kOnePoint};
    return;
  }
  if (first.sums == kOnePoint) {
    first.sums = static_cast<std::uint32_t>(sums_.size());
    sums_.push_back({1});
  }
  Sums& s = sums_[first.sums];
  ++s.points;
  const std::int64_t x = (std::int64_t{p.x} - first.origin.x) >> shift_;
  const std::int64_t y = (std::int64_t{p.y} - first.origin.y) >> shift_;
  const std::int64_t z = (std::int64_t{p.z} - first.origin.z) >> shift_;
  s.first[0] += x;
  s.first[1] += y;
  s.first[2] += z;
  s.second[0] += x * x;
  s.second[1] += x * y;
  s.second[2] += x * z;
  s.second[3] += y * y;
  s.second[4] += y * z;
  s.second[5] += z * z;
}

SupervoxelTable SupervoxelMoments::table(std::span<const std::pair<std::uint32_t, std::uint32_t>> adjacency) const {
  SupervoxelTable table;
  const std::size_t size = first_.size();
  table.normal.resize(size);
  table.centroid.resize(size);
  table.spacing.resize(size);
  table.thickness.resize(size);
  const double unit = std::ldexp(1.0, shift_);
  for (std::uint32_t id = 1; id < size; ++id) {
    const Sums& s = sums_of(id);
    if (s.points == 0) continue;
    const double n = static_cast<double>(s.points);
    const std::array<double, 3> mean{static_cast<double>(s.first[0]) / n, static_cast<double>(s.first[1]) / n,
                                     static_cast<double>(s.first[2]) / n};
    const LatticePoint& origin = first_[id].origin;
    table.centroid[id] = {origin.x + unit * mean[0], origin.y + unit * mean[1], origin.z + unit * mean[2]};
    const auto moment = [&](std::size_t i, std::size_t a, std::size_t b) {
      return static_cast<double>(s.second[i]) / n - mean[a] * mean[b];
    };
    const SymmetricMatrix<double> covariance{moment(0, 0, 0), moment(1, 0, 1), moment(2, 0, 2),
                                             moment(3, 1, 1), moment(4, 1, 2), moment(5, 2, 2)};
    const Eigenvalues<double> values = eigenvalues_of(covariance);
    if (s.points < 3 || !(values.middle > kLeastWidth * values.largest)) continue;
    const Vector3 normal = principal_frame(covariance, values).e3;
    table.normal[id] = {static_cast<float>(normal[0]), static_cast<float>(normal[1]), static_cast<float>(normal[2])};
    table.thickness[id] = static_cast<float>(unit * std::sqrt(std::max(values.smallest, 0.0)));
    // A disc of uniform density has eigenvalues r^2 / 4: its area is 4 pi sqrt(product), whatever ellipse it becomes.
    const double area = 4.0 * kPi * std::sqrt(values.largest * values.middle) * unit * unit;
    table.spacing[id] = static_cast<float>(std::sqrt(area / n));
  }
  table.begin.assign(size + 1, 0);
  for (const auto& [a, b] : adjacency) {
    ++table.begin[a + 1];
    ++table.begin[b + 1];
  }
  for (std::size_t id = 0; id < size; ++id) table.begin[id + 1] += table.begin[id];
  table.neighbours.resize(2 * adjacency.size());
  std::vector<std::uint32_t> next(table.begin.begin(), table.begin.end() - 1);
  for (const auto& [a, b] : adjacency) table.neighbours[next[b]++] = a;  // Smaller ids first: both loops ascend.
  for (const auto& [a, b] : adjacency) table.neighbours[next[a]++] = b;
  return table;
}

}  // namespace arris::merge
