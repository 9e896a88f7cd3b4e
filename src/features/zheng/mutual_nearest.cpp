#include "features/zheng/mutual_nearest.h"

namespace arris {

NearestPoint nearest_in(const PointTree& tree, const LabelledGroup& group, const LabelledPart& part, const Vector3& at,
                        double most_d2) {
  NearestPoint nearest;
  double bound = most_d2;
  for (std::size_t i = part.begin; i < part.end; ++i) {
    const double dx = group.x()[i] - at[0];
    const double dy = group.y()[i] - at[1];
    const double dz = group.z()[i] - at[2];
    const double d2 = dx * dx + dy * dy + dz * dz;
    if (d2 > bound) continue;
    if (d2 == nearest.d2 && tree.id(group.slot(i)) > tree.id(group.slot(nearest.index))) continue;
    nearest = {i, d2};
    bound = d2;
  }
  return nearest;
}

bool any_within(const LabelledGroup& group, const LabelledPart& part, const Vector3& at, double most_d2) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = part.begin; i < part.end; ++i) {
    const double dx = group.x()[i] - at[0];
    const double dy = group.y()[i] - at[1];
    const double dz = group.z()[i] - at[2];
    const double d2 = dx * dx + dy * dy + dz * dz;
    least = d2 < least ? d2 : least;
  }
  return least <= most_d2;
}

NearestPoint mutual_nearest(const PointTree& tree, const LabelledGroup& group, std::uint32_t slot,
                            const LabelledPart& own, const LabelledPart& other, double cap_d2) {
  const NearestPoint there = nearest_in(tree, group, other, group.relative(tree, slot), cap_d2);
  if (!(there.d2 <= cap_d2)) return {};
  const NearestPoint back = nearest_in(tree, group, own, group.at(there.index), there.d2);
  return group.slot(back.index) == slot ? there : NearestPoint{};
}

}  // namespace arris
