#pragma once
/// @file Searches for queries that are close together: what lies around all of them is gathered once.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "features/ball_moments.h"
#include "features/candidate_set.h"
#include "features/exact_math.h"
#include "features/nearest_select.h"
#include "features/point_tree.h"

namespace arris {

/// The narrowest type to compute in. All give the same results; wider ones are taken where a narrower is not exact.
enum class Arithmetic : std::uint8_t { kFloat, kDouble, kInt64 };

struct SearchLimits {
  std::size_t k = 0;         ///< Neighbours wanted.
  double max_reach = 0.0;    ///< R_max, steps, at most kMostReach.
  std::uint64_t max_d2 = 0;  ///< floor(R_max²).
  Arithmetic narrowest = Arithmetic::kFloat;
};

namespace detail {

/// Box around the slots of queries.
template <class Query, class SlotOf>
ClosedBox box_of(const PointTree& tree, std::span<const Query> queries, SlotOf&& slot_of) {
  const LatticePoint first = tree.position(slot_of(queries[0]));
  ClosedBox box{{first.x, first.y, first.z}, {first.x, first.y, first.z}};
  for (const Query& query : queries) {
    const LatticePoint p = tree.position(slot_of(query));
    for (int axis = 0; axis < 3; ++axis) {
      box.min[axis] = std::min(box.min[axis], p[axis]);
      box.max[axis] = std::max(box.max[axis], p[axis]);
    }
  }
  return box;
}

/// floor(reach²) as an exact T, at most max_d2.
template <class T>
T squared_limit(double reach, std::uint64_t max_d2) {
  return static_cast<T>(std::min(static_cast<std::uint64_t>(reach * reach), max_d2));
}

}  // namespace detail

/// The k nearest neighbours within R_max of each query of a group. How far the first gathering reaches is guessed from
/// the group before; queries that need more are run again. That decides the speed only. Not thread-safe.
class NeighbourSearch {
 public:
  NeighbourSearch(const PointTree& tree, const SearchLimits& limits) : tree_(tree), limits_(limits) {
    neighbours_.reserve(limits.k);
  }

  /// Calls use(slot, neighbours) once per slot, in any order.
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
    work.guess_d2 = detail::squared_limit<T>(reach / kReachMargin, limits_.max_d2);
    for (const std::uint32_t slot : slots) {
      if (find(work, slot, reach)) {
        reach_sum_ += std::sqrt(static_cast<double>(neighbours_.last_d2));
        ++measured_;
        use(slot, static_cast<const Neighbours&>(neighbours_));
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
    query.max_d2 = detail::squared_limit<T>(reach, limits_.max_d2);
    query.guess_d2 = work.guess_d2;
    select_nearest(tree_, work.candidates, query, work.nearest, neighbours_);
    if (neighbours_.count < query.k) return static_cast<std::uint64_t>(query.max_d2) == limits_.max_d2;
    work.guess_d2 = static_cast<T>(1.1 * static_cast<double>(neighbours_.last_d2) + 1.0);
    return true;
  }

  const PointTree& tree_;
  SearchLimits limits_;
  Workspace<float> floats_;
  Workspace<double> doubles_;
  Workspace<std::int64_t> integers_;
  Neighbours neighbours_;
  std::vector<std::uint32_t> pending_;  ///< Queries that the current reach did not do for.
  double reach_sum_ = 0.0;              ///< Of the distances of last neighbours in the current group.
  std::size_t measured_ = 0;
};

/// A ball around a point; `query` is for the caller.
struct Ball {
  std::uint32_t slot = 0;
  double radius = 0.0;  ///< Steps.
  std::uint32_t query = 0;
};

/// The points in balls that are close together. Not thread-safe.
class BallSearch {
 public:
  /// What must be exact in the T of the candidates.
  enum class Exact : std::uint8_t { kSquares, kSums };

  BallSearch(const PointTree& tree, Arithmetic narrowest, Exact exact)
      : tree_(tree), narrowest_(narrowest), exact_(exact) {}

  /// Calls use(candidates, ball query, ball) once per ball, in any order, with a CandidateSet<T>. Reorders `balls`.
  template <class Use>
  void run(std::vector<Ball>& balls, Use&& use) {
    // Balls of one size together; the few large ones would only burden the others.
    std::sort(balls.begin(), balls.end(), [](const Ball& a, const Ball& b) {
      return a.radius != b.radius ? a.radius < b.radius : a.slot < b.slot;
    });
    for (std::span<const Ball> left(balls); !left.empty();) {
      const double most = kBallSpread * left[left.size() / 2].radius;
      std::size_t take = left.size();
      while (left[take - 1].radius > most) --take;
      run_group(left.first(take), use);
      left = left.subspan(take);
    }
  }

 private:
  /// Balls up to this much larger than the median of their group share its candidates.
  static constexpr double kBallSpread = 1.3;

  template <class Use>
  void run_group(std::span<const Ball> balls, Use& use) {
    if (narrowest_ <= Arithmetic::kFloat && try_group(floats_, balls, use)) return;
    if (narrowest_ <= Arithmetic::kDouble && try_group(doubles_, balls, use)) return;
    try_group(integers_, balls, use);
  }

  /// Balls in ascending order of their radii.
  template <class T, class Use>
  bool try_group(CandidateSet<T>& candidates, std::span<const Ball> balls, Use& use) {
    const double reach = balls.back().radius;
    if ((reach + 1.0) * (reach + 1.0) >= kExactSquares<T>) return false;
    const ClosedBox box = detail::box_of(tree_, balls, [](const Ball& ball) { return ball.slot; });
    if (!candidates.gather(tree_, box, reach)) return false;
    if (exact_ == Exact::kSums && !ball_sums_are_exact<T>(reach, candidates.count)) return false;
    for (const Ball& ball : balls) {
      BallQuery<T> query;
      query.x = static_cast<T>(tree_.x()[ball.slot] - candidates.origin[0]);
      query.y = static_cast<T>(tree_.y()[ball.slot] - candidates.origin[1]);
      query.z = static_cast<T>(tree_.z()[ball.slot] - candidates.origin[2]);
      query.radius2 = static_cast<T>(static_cast<std::uint64_t>(ball.radius * ball.radius));
      use(static_cast<const CandidateSet<T>&>(candidates), query, ball);
    }
    return true;
  }

  const PointTree& tree_;
  Arithmetic narrowest_;
  Exact exact_;
  CandidateSet<float> floats_;
  CandidateSet<double> doubles_;
  CandidateSet<std::int64_t> integers_;
};

/// Larger balls around some points of a group, asked for one by one. The second question gathers for the whole group.
/// Not thread-safe.
class SharedBalls {
 public:
  explicit SharedBalls(const PointTree& tree)
      : tree_(tree), single_(tree, Arithmetic::kFloat, BallSearch::Exact::kSquares) {}

  /// A new group begins: points that are close together, with balls of `reach` steps for most of them.
  void begin(std::span<const Ball> group, double reach) {
    group_.assign(group.begin(), group.end());
    reach_ = reach;
    questions_ = 0;
    gathered_ = Gathered::kNothing;
  }

  /// Calls use(candidates, ball query) for a ball around a point of the group.
  template <class Use>
  void run(const Ball& ball, Use&& use) {
    if (ball.radius > reach_ || ++questions_ < 2 || !gather()) {
      one_.assign(1, ball);
      single_.run(one_, [&](const auto& candidates, const auto& query, const Ball&) { use(candidates, query); });
      return;
    }
    if (gathered_ == Gathered::kFloats) {
      use(static_cast<const CandidateSet<float>&>(floats_), query_of(floats_, ball));
    } else {
      use(static_cast<const CandidateSet<double>&>(doubles_), query_of(doubles_, ball));
    }
  }

 private:
  enum class Gathered : std::uint8_t { kNothing, kFloats, kDoubles };

  bool gather() {
    if (gathered_ != Gathered::kNothing) return true;
    const ClosedBox box =
        detail::box_of(tree_, std::span<const Ball>(group_), [](const Ball& ball) { return ball.slot; });
    const double squares = (reach_ + 1.0) * (reach_ + 1.0);
    if (squares < kExactSquares<float> && floats_.gather(tree_, box, reach_)) {
      gathered_ = Gathered::kFloats;
    } else if (squares < kExactSquares<double> && doubles_.gather(tree_, box, reach_)) {
      gathered_ = Gathered::kDoubles;
    }
    return gathered_ != Gathered::kNothing;
  }

  template <class T>
  BallQuery<T> query_of(const CandidateSet<T>& candidates, const Ball& ball) const {
    return {static_cast<T>(tree_.x()[ball.slot] - candidates.origin[0]),
            static_cast<T>(tree_.y()[ball.slot] - candidates.origin[1]),
            static_cast<T>(tree_.z()[ball.slot] - candidates.origin[2]),
            static_cast<T>(static_cast<std::uint64_t>(ball.radius * ball.radius))};
  }

  const PointTree& tree_;
  BallSearch single_;
  std::vector<Ball> group_, one_;
  double reach_ = 0.0;
  int questions_ = 0;
  Gathered gathered_ = Gathered::kNothing;
  CandidateSet<float> floats_;
  CandidateSet<double> doubles_;
};

}  // namespace arris
