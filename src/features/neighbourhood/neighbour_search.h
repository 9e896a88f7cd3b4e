#pragma once
/// @file Nearest neighbours of queries that are close together: what lies around all of them is gathered once.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "features/neighbourhood/candidate_set.h"
#include "features/neighbourhood/group_box.h"
#include "features/neighbourhood/nearest_select.h"
#include "features/numerics/exact_math.h"

namespace arris {

struct SearchLimits {
  std::size_t k = 0;         ///< Neighbours wanted.
  double max_reach = 0.0;    ///< R_max, steps, at most kMostReach.
  std::uint64_t max_d2 = 0;  ///< floor(R_max²).
  Arithmetic narrowest = Arithmetic::kFloat;
};

/// The k nearest neighbours within R_max of each query of a group. How far the first gathering reaches is guessed from
/// the group before; queries that need more are run again. That decides the speed only. Not thread-safe.
///
/// `Found` is what is told of the neighbours: anything that select_nearest() fills, with a count and last_d2_guess(),
/// the squared distance within which they are, about.
template <class Found>
class NearestSearch {
 public:
  NearestSearch(const PointTree& tree, const SearchLimits& limits) : tree_(tree), limits_(limits) {
    neighbours_.reserve(limits.k);
  }

  /// Calls use(slot, neighbours) once per slot, in any order. To keep neighbours, `use` may swap others with room for k
  /// for them.
  template <class Use>
  void run(std::span<const std::uint32_t> slots, Use&& use) {
    if (slots.empty()) return;
    double reach = first_reach(slots);
    reach_sum_ = 0.0;
    measured_ = 0;
    pending_.clear();
    run_at(slots, reach, use);
    while (!pending_.empty()) {
      reach = std::min(kReachGrowth * reach + 1.0, limits_.max_reach);
      const std::vector<std::uint32_t> again = std::move(pending_);
      pending_.clear();
      run_at(again, reach, use);
    }
  }

 private:
  /// floor(reach²) as an exact T, at most max_d2.
  template <class T>
  static T squared_limit(double reach, std::uint64_t max_d2) {
    return static_cast<T>(std::min(static_cast<std::uint64_t>(reach * reach), max_d2));
  }

  /// The first reach is guessed this much above the mean need of the group before: most queries then need no second
  /// gathering, and candidates stay few.
  static constexpr double kReachMargin = 1.25;
  static constexpr double kReachGrowth = 1.4;

  template <class T>
  struct Workspace {
    CandidateSet<T> candidates;
    NearestScratch<T> nearest;
    T guess_d2 = 0;
  };

  ClosedBox box_of(std::span<const std::uint32_t> slots) const {
    return detail::box_of(tree_, slots, [](std::uint32_t slot) { return slot; });
  }

  double first_reach(std::span<const std::uint32_t> slots) const {
    double reach = 0.0;
    if (measured_ > 0) {
      reach = kReachMargin * reach_sum_ / static_cast<double>(measured_);
    } else {
      // As if the points lay on a plane that the two longest sides of their box span.
      const ClosedBox box = box_of(slots);
      double sides[3];
      for (int axis = 0; axis < 3; ++axis) sides[axis] = static_cast<double>(box.max[axis]) - box.min[axis] + 1.0;
      std::sort(std::begin(sides), std::end(sides));
      const double points = static_cast<double>(slots.size());
      reach = 1.5 * std::sqrt(sides[1] * sides[2] / points * static_cast<double>(limits_.k) / kPi);
    }
    return std::min(std::max(reach, 2.0), limits_.max_reach);
  }

  template <class Use>
  void run_at(std::span<const std::uint32_t> slots, double reach, Use& use) {
    if (limits_.narrowest <= Arithmetic::kFloat && try_at(floats_, slots, reach, use)) return;
    if (limits_.narrowest <= Arithmetic::kDouble && try_at(doubles_, slots, reach, use)) return;
    try_at(integers_, slots, reach, use);
  }

  template <class T, class Use>
  bool try_at(Workspace<T>& work, std::span<const std::uint32_t> slots, double reach, Use& use) {
    if ((reach + 1.0) * (reach + 1.0) >= kExactSquares<T>) return false;
    if (!work.candidates.gather(tree_, box_of(slots), reach)) return false;
    if constexpr (Found::kOfPacked) work.candidates.pack();
    work.guess_d2 = squared_limit<T>(reach / kReachMargin, limits_.max_d2);
    for (const std::uint32_t slot : slots) {
      if (find(work, slot, reach)) {
        reach_sum_ += std::sqrt(neighbours_.last_d2_guess());
        ++measured_;
        use(slot, neighbours_);
      } else {
        pending_.push_back(slot);
      }
    }
    return true;
  }

  /// False if neighbours may lie beyond the reach.
  template <class T>
  bool find(Workspace<T>& work, std::uint32_t slot, double reach) {
    NearestQuery<T> query;
    query.x = static_cast<T>(tree_.x()[slot] - work.candidates.origin[0]);
    query.y = static_cast<T>(tree_.y()[slot] - work.candidates.origin[1]);
    query.z = static_cast<T>(tree_.z()[slot] - work.candidates.origin[2]);
    query.k = limits_.k;
    query.max_d2 = squared_limit<T>(reach, limits_.max_d2);
    query.guess_d2 = work.guess_d2;
    select_nearest(tree_, work.candidates, query, work.nearest, neighbours_);
    if (neighbours_.count < query.k) return static_cast<std::uint64_t>(query.max_d2) == limits_.max_d2;
    work.guess_d2 = static_cast<T>(1.2 * neighbours_.last_d2_guess() + 1.0);
    return true;
  }

  const PointTree& tree_;
  SearchLimits limits_;
  Workspace<float> floats_;
  Workspace<double> doubles_;
  Workspace<std::int64_t> integers_;
  Found neighbours_;
  std::vector<std::uint32_t> pending_;  ///< Queries that the current reach did not do for.
  double reach_sum_ = 0.0;              ///< Of the distances of last neighbours in the current group.
  std::size_t measured_ = 0;
};

using NeighbourSearch = NearestSearch<Neighbours>;

}  // namespace arris
