#include "segment_testing.h"

#include <algorithm>
#include <cmath>

namespace arris::test {

std::vector<SegmentPlane> planes_of(std::span<const LatticePoint> positions, const std::vector<std::uint32_t>& labels,
                                    double spacing) {
  const std::uint32_t count = labels.empty() ? 0 : *std::max_element(labels.begin(), labels.end());
  std::vector<SegmentPlane> planes(count);
  for (std::uint32_t label = 1; label <= count; ++label) {
    SegmentPlane& plane = planes[label - 1];
    plane.spacing = spacing;
    double n = 0.0;
    const auto for_each = [&](auto use) {
      for (std::size_t i = 0; i < positions.size(); ++i) {
        const LatticePoint& p = positions[i];
        if (labels[i] == label) use(Vector3{double(p.x), double(p.y), double(p.z)});
      }
    };
    for_each([&](const Vector3& p) {
      ++n;
      for (std::size_t axis = 0; axis < 3; ++axis) plane.centroid[axis] += p[axis];
    });
    if (n == 0.0) continue;
    for (double& c : plane.centroid) c /= n;
    SymmetricMatrix<double> m{0, 0, 0, 0, 0, 0};
    for_each([&](const Vector3& p) {
      const double x = p[0] - plane.centroid[0], y = p[1] - plane.centroid[1], z = p[2] - plane.centroid[2];
      m.xx += x * x / n;
      m.xy += x * y / n;
      m.xz += x * z / n;
      m.yy += y * y / n;
      m.yz += y * z / n;
      m.zz += z * z / n;
    });
    const PrincipalFrame frame = principal_frame(m);
    plane.normal = frame.e3;
    if (plane.normal[2] < 0.0) {
      for (double& c : plane.normal) c = -c;
    }
    plane.rms = std::sqrt(std::max(frame.values.smallest, 0.0));
  }
  return planes;
}

}  // namespace arris::test
