#include "features/contour/contour_finish.h"

#include <cmath>

#include "core/columns.h"

namespace arris {
namespace {

/// Along the contour, spacings.
constexpr double kChainReach = 0.5;
/// Points farther than this from the contour are not of its chain.
constexpr double kChainWidth = 1.5;
/// Cosine of the angle between the view and the fold's opening below which neither side is seen clearly.
constexpr double kLeastSideCosine = 0.2;

}  // namespace

bool leads_chain(const BallPoints& points, const PointContour& contour) {
  const auto squared_offset = [&](const Vector3& from_nearest) {
    const double t = dot(contour.direction, from_nearest);
    return dot(from_nearest, from_nearest) - t * t;
  };
  const Vector3 own{-contour.nearest[0], -contour.nearest[1], -contour.nearest[2]};
  const double own_t = dot(contour.direction, own);
  const double own_offset2 = squared_offset(own);
  for (std::size_t i = 0; i < points.count; ++i) {
    const double x = points.x[i], y = points.y[i], z = points.z[i];
    if (x == 0.0 && y == 0.0 && z == 0.0) continue;  // The point itself.
    const Vector3 q{x + own[0], y + own[1], z + own[2]};
    if (std::fabs(dot(contour.direction, q) - own_t) > kChainReach) continue;
    const double offset2 = squared_offset(q);
    if (offset2 > kChainWidth * kChainWidth || offset2 > own_offset2) continue;
    const bool first = x != 0.0 ? x < 0.0 : y != 0.0 ? y < 0.0 : z < 0.0;
    if (offset2 < own_offset2 || first) return false;
  }
  return true;
}

std::uint8_t fold_side(const FoldLine& line, const Vector3& view) {
  const double along = dot(view, line.direction);
  Vector3 across;
  for (int axis = 0; axis < 3; ++axis) across[axis] = view[axis] - along * line.direction[axis];
  const double length2 = dot(view, view);
  const double towards = dot(across, line.opening);
  if (!(towards * towards > kLeastSideCosine * kLeastSideCosine * length2)) return 0;
  return towards > 0.0 ? kConcave : kConvex;
}

}  // namespace arris
