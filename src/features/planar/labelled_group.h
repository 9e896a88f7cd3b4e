#pragma once
/// @file The points around a group of queries, sorted by their labels.

#include <cstdint>
#include <span>
#include <vector>

#include "features/neighbourhood/candidate_set.h"
#include "features/numerics/symmetric_eigen3.h"

namespace arris {

/// Points of one supervoxel or segment in a LabelledGroup: [begin, end) of its columns.
struct LabelledPart {
  std::uint32_t label = 0;
  std::size_t begin = 0, end = 0;
};

/// Points relative to an origin, the middle of the box that they were gathered around, as structure of arrays; parts in
/// ascending order of labels, points without one left out. Coordinates and their differences are exact.
class LabelledGroup {
 public:
  /// All labelled points within `reach` steps of `box`, and some more.
  /// @param labels  in the tree's order.
  /// O(points in the buckets that the reach touches).
  void gather(const PointTree& tree, std::span<const std::uint32_t> labels, const ClosedBox& box, double reach);

  const std::vector<LabelledPart>& parts() const { return parts_; }
  /// Null if no point with this label was gathered.
  const LabelledPart* part(std::uint32_t label) const;
  const double* x() const { return x_.data(); }
  const double* y() const { return y_.data(); }
  const double* z() const { return z_.data(); }
  std::uint32_t slot(std::size_t index) const { return slots_[index]; }
  Vector3 at(std::size_t index) const { return {x_[index], y_[index], z_[index]}; }
  /// A point of the tree, gathered or not, relative to the same origin.
  Vector3 relative(const PointTree& tree, std::uint32_t slot) const;
  Vector3 origin() const;

 private:
  template <class T>
  void sort(const CandidateSet<T>& candidates, std::span<const std::uint32_t> labels);

  CandidateSet<float> floats_;  ///< The faster one, where it is exact.
  CandidateSet<double> doubles_;
  std::int64_t origin_[3] = {0, 0, 0};
  std::vector<std::uint32_t> part_of_;
  std::vector<LabelledPart> parts_;
  std::vector<double> x_, y_, z_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace arris
