#include "evaluate/plane_relations.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace arris::evaluate {

namespace {

/// Place of a label, or the number of labels if it is not there.
std::size_t place_of(std::span<const LabelSize> sizes, std::uint32_t label) {
  const auto found = std::lower_bound(sizes.begin(), sizes.end(), label,
                                      [](const LabelSize& size, std::uint32_t l) { return size.label < l; });
  if (found == sizes.end() || found->label != label) return sizes.size();
  return static_cast<std::size_t>(found - sizes.begin());
}

/// Sets of planes and segments; planes come first.
class Groups {
 public:
  explicit Groups(std::size_t members) : parent_(members) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t first_of(std::size_t member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }
  void join(std::size_t a, std::size_t b) {
    const std::size_t first_a = first_of(a), first_b = first_of(b);
    parent_[std::max(first_a, first_b)] = std::min(first_a, first_b);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

PlaneRelations relate_planes(std::span<const LabelOverlap> overlaps, std::span<const LabelSize> planes,
                             std::span<const LabelSize> segments) {
  const std::size_t members = planes.size() + segments.size();
  Groups groups(members);
  for (const LabelOverlap& overlap : overlaps) {
    const std::size_t plane = place_of(planes, overlap.face), segment = place_of(segments, overlap.segment);
    if (plane == planes.size() || segment == segments.size()) continue;
    if (2 * overlap.points < planes[plane].points && 2 * overlap.points < segments[segment].points) continue;
    groups.join(plane, planes.size() + segment);
  }
  std::vector<std::uint64_t> planes_in(members, 0), segments_in(members, 0);
  for (std::size_t i = 0; i < members; ++i) ++(i < planes.size() ? planes_in : segments_in)[groups.first_of(i)];
  PlaneRelations result;
  for (std::size_t i = 0; i < members; ++i) {
    const std::uint64_t n = planes_in[i], m = segments_in[i];
    if (n == 0 && m == 0) continue;
    if (m == 0)
      ++result.planes_alone;
    else if (n == 0)
      ++result.segments_alone;
    else if (n == 1)
      ++(m == 1 ? result.one_to_one : result.one_to_many);
    else
      ++(m == 1 ? result.many_to_one : result.many_to_many);
  }
  return result;
}

}  // namespace arris::evaluate
