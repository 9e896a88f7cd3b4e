#include "merge/segment_moments.h"

#include <algorithm>
#include <cmath>

namespace arris::merge {
namespace {

bool is_below(const Vector3& a, const Vector3& b) {
  for (const int axis : {2, 1, 0}) {
    if (a[axis] != b[axis]) return a[axis] < b[axis];
  }
  return false;
}

}  // namespace

void SegmentMoments::change(std::uint32_t segment, const LatticePoint& p, int sign) {
  Sums& s = sums_[segment - 1];
  if (!s.has_origin) {
    s.origin = p;
    s.has_origin = true;
  }
  s.points += static_cast<std::uint64_t>(std::int64_t{sign});
  const std::int64_t x = std::int64_t{p.x} - s.origin.x;
  const std::int64_t y = std::int64_t{p.y} - s.origin.y;
  const std::int64_t z = std::int64_t{p.z} - s.origin.z;
  const std::int64_t signed_x = sign * x, signed_y = sign * y, signed_z = sign * z;
  // One multiplication of 64 by 64 bits each.
  s.first[0] += signed_x;
  s.first[1] += signed_y;
  s.first[2] += signed_z;
  s.second[0] += Wide{signed_x} * x;
  s.second[1] += Wide{signed_x} * y;
  s.second[2] += Wide{signed_x} * z;
  s.second[3] += Wide{signed_y} * y;
  s.second[4] += Wide{signed_y} * z;
  s.second[5] += Wide{signed_z} * z;
}

SegmentPlane SegmentMoments::plane(std::uint32_t segment) const {
  const Sums& s = sums_[segment - 1];
  SegmentPlane plane;
  if (s.points == 0) return plane;
  const double n = static_cast<double>(s.points);
  // About an origin that is a point of the segment, which leaves the differences enough digits.
  std::array<double, 3> mean{};
  for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] = static_cast<double>(s.first[axis]) / n;
  const auto moment = [&](std::size_t i, std::size_t a, std::size_t b) {
    return static_cast<double>(s.second[i]) / n - mean[a] * mean[b];
  };
  const SymmetricMatrix<double> covariance{moment(0, 0, 0), moment(1, 0, 1), moment(2, 0, 2),
                                           moment(3, 1, 1), moment(4, 1, 2), moment(5, 2, 2)};
  const PrincipalFrame frame = principal_frame(covariance);
  const Vector3 opposite{-frame.e3[0], -frame.e3[1], -frame.e3[2]};
  plane.normal = is_below(frame.e3, opposite) ? opposite : frame.e3;
  plane.centroid = {s.origin.x + mean[0], s.origin.y + mean[1], s.origin.z + mean[2]};
  plane.rms = std::sqrt(std::max(frame.values.smallest, 0.0));
  return plane;
}

}  // namespace arris::merge
