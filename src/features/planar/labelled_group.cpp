#include "features/planar/labelled_group.h"

#include <algorithm>
#include <iterator>

namespace arris {

void LabelledGroup::gather(const PointTree& tree, std::span<const std::uint32_t> labels, const ClosedBox& box,
                           double reach) {
  if ((reach + 1.0) * (reach + 1.0) < kExactSquares<float> && floats_.gather(tree, box, reach)) {
    sort(floats_, labels);
  } else {
    doubles_.gather(tree, box, reach);  // Lattice coordinates are always exact in double.
    sort(doubles_, labels);
  }
}

template <class T>
void LabelledGroup::sort(const CandidateSet<T>& candidates, std::span<const std::uint32_t> labels) {
  const std::size_t n = candidates.count;
  std::copy(std::begin(candidates.origin), std::end(candidates.origin), std::begin(origin_));
  parts_.clear();
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t label = labels[candidates.slot[i]];
    if (label == last) continue;
    last = label;
    if (label != 0) parts_.push_back({label, 0, 0});
  }
  std::sort(parts_.begin(), parts_.end(),
            [](const LabelledPart& a, const LabelledPart& b) { return a.label < b.label; });
  parts_.erase(std::unique(parts_.begin(), parts_.end(),
                           [](const LabelledPart& a, const LabelledPart& b) { return a.label == b.label; }),
               parts_.end());
  part_of_.resize(n);
  last = 0;
  std::uint32_t current = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t label = labels[candidates.slot[i]];
    if (label == 0) continue;
    if (label != last) current = static_cast<std::uint32_t>(part(label) - parts_.data());
    last = label;
    part_of_[i] = current;
    ++parts_[current].end;
  }
  std::size_t total = 0;
  for (LabelledPart& part : parts_) {
    const std::size_t size = part.end;
    part.begin = part.end = total;
    total += size;
  }
  for (auto* column : {&x_, &y_, &z_}) column->resize(total);
  slots_.resize(total);
  for (std::size_t i = 0; i < n; ++i) {
    if (labels[candidates.slot[i]] == 0) continue;
    const std::size_t to = parts_[part_of_[i]].end++;
    x_[to] = candidates.x[i];
    y_[to] = candidates.y[i];
    z_[to] = candidates.z[i];
    slots_[to] = candidates.slot[i];
  }
}

const LabelledPart* LabelledGroup::part(std::uint32_t label) const {
  const auto found = std::lower_bound(parts_.begin(), parts_.end(), label,
                                      [](const LabelledPart& a, std::uint32_t wanted) { return a.label < wanted; });
  return found != parts_.end() && found->label == label ? &*found : nullptr;
}

Vector3 LabelledGroup::relative(const PointTree& tree, std::uint32_t slot) const {
  return {static_cast<double>(tree.x()[slot] - origin_[0]), static_cast<double>(tree.y()[slot] - origin_[1]),
          static_cast<double>(tree.z()[slot] - origin_[2])};
}

Vector3 LabelledGroup::origin() const {
  return {static_cast<double>(origin_[0]), static_cast<double>(origin_[1]), static_cast<double>(origin_[2])};
}

}  // namespace arris
