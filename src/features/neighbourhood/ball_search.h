#pragma once
/// @file The points in balls around points that are close together.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "features/neighbourhood/ball_moments.h"
#include "features/neighbourhood/candidate_set.h"
#include "features/neighbourhood/group_box.h"

namespace arris {

/// A ball around a point; `query` is for the caller.
struct Ball {
  std::uint32_t slot = 0;
  double radius = 0.0;  ///< Steps.
  std::uint32_t query = 0;
};

/// What to ask of candidates that were gathered around the ball.
template <class T>
BallQuery<T> query_of(const PointTree& tree, const CandidateSet<T>& candidates, const Ball& ball) {
  return {static_cast<T>(tree.x()[ball.slot] - candidates.origin[0]),
          static_cast<T>(tree.y()[ball.slot] - candidates.origin[1]),
          static_cast<T>(tree.z()[ball.slot] - candidates.origin[2]),
          static_cast<T>(static_cast<std::uint64_t>(ball.radius * ball.radius))};
}

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
    run_groups(balls, [&use](const auto& candidates, const auto& queries, std::span<const Ball> group) {
      for (std::size_t i = 0; i < group.size(); ++i) use(candidates, queries[i], group[i]);
    });
  }

  /// The same, for whole groups of balls that share their candidates: use(candidates, queries, balls), one query per
  /// ball.
  template <class Use>
  void run_groups(std::vector<Ball>& balls, Use&& use) {
    // Balls of one size together; the few large ones would only burden the others.
    for (std::span<Ball> left(balls); !left.empty();) {
      double sum = 0.0;
      for (const Ball& ball : left) sum += ball.radius;
      const double most = kBallSpread * sum / static_cast<double>(left.size());
      const auto larger =
          std::partition(left.begin(), left.end(), [=](const Ball& ball) { return ball.radius <= most; });
      const std::size_t take = static_cast<std::size_t>(larger - left.begin());
      run_group(left.first(take), use);
      left = left.subspan(take);
    }
  }

 private:
  /// Balls up to this much larger than the mean of those left share their candidates.
  static constexpr double kBallSpread = 1.3;

  template <class Use>
  void run_group(std::span<const Ball> balls, Use& use) {
    if (narrowest_ <= Arithmetic::kFloat && try_group(floats_, balls, use)) return;
    if (narrowest_ <= Arithmetic::kDouble && try_group(doubles_, balls, use)) return;
    try_group(integers_, balls, use);
  }

  template <class T>
  struct Workspace {
    CandidateSet<T> candidates;
    std::vector<BallQuery<T>> queries;
  };

  template <class T, class Use>
  bool try_group(Workspace<T>& work, std::span<const Ball> balls, Use& use) {
    CandidateSet<T>& candidates = work.candidates;
    double reach = 0.0;
    for (const Ball& ball : balls) reach = std::max(reach, ball.radius);
    if ((reach + 1.0) * (reach + 1.0) >= kExactSquares<T>) return false;
    const ClosedBox box = detail::box_of(tree_, balls, [](const Ball& ball) { return ball.slot; });
    if (!candidates.gather(tree_, box, reach)) return false;
    if (exact_ == Exact::kSums) {
      if (!ball_sums_are_exact<T>(reach)) return false;
      candidates.multiply();
    }
    work.queries.clear();
    for (const Ball& ball : balls) work.queries.push_back(query_of(tree_, candidates, ball));
    use(static_cast<const CandidateSet<T>&>(candidates), std::span<const BallQuery<T>>(work.queries), balls);
    return true;
  }

  const PointTree& tree_;
  Arithmetic narrowest_;
  Exact exact_;
  Workspace<float> floats_;
  Workspace<double> doubles_;
  Workspace<std::int64_t> integers_;
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
      use(static_cast<const CandidateSet<float>&>(floats_), query_of(tree_, floats_, ball));
    } else {
      use(static_cast<const CandidateSet<double>&>(doubles_), query_of(tree_, doubles_, ball));
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
