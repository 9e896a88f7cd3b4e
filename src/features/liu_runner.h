#pragma once
/// @file Runs the method for the queries of one bucket after the other; one runner per chunk of buckets.

#include <cstdint>
#include <span>
#include <vector>

#include "features/candidate_set.h"
#include "features/contour_accumulator.h"
#include "features/liu_method.h"
#include "features/liu_settings.h"
#include "features/nearest_select.h"
#include "features/point_tree.h"

namespace arris {

/// What all runners of a tile share. Read only, but for the accumulator.
struct LiuTask {
  const PointTree& tree;
  const LatticeBox& covered;
  const LiuSettings& settings;
  ContourAccumulator& results;
};

/// A fold test to be made.
struct LiuBall {
  std::uint32_t slot;
  FoldThresholds thresholds;
};

/// Not thread-safe; make one per chunk. Candidates are gathered once for all queries of a group, first for the
/// neighbours and the boundary test, then for the balls, whose radii are known by then. How far the first gathering
/// reaches is guessed from the group before; queries that need more are run again. That decides the speed only.
class LiuRunner {
 public:
  explicit LiuRunner(const LiuTask& task);

  /// `slots`: queries that are close together, in tree order.
  void run(std::span<const std::uint32_t> slots);

  std::vector<UnprovenQuery> take_unproven() { return std::move(unproven_); }

 private:
  template <class T>
  struct Arithmetic {
    CandidateSet<T> candidates;
    NearestScratch<T> nearest;
    T guess_d2 = 0;
  };

  void run_neighbours(std::span<const std::uint32_t> slots, double reach);
  template <class T>
  bool try_neighbours(Arithmetic<T>& arithmetic, std::span<const std::uint32_t> slots, double reach);
  template <class T>
  bool find_neighbours(Arithmetic<T>& arithmetic, std::uint32_t slot, double reach);
  void use_neighbours(std::uint32_t slot);
  bool proven(std::uint32_t slot, const FoldThresholds& fold);
  void test_boundary(std::uint32_t slot, const LocalSpacing& spacing);

  void run_balls(std::span<const LiuBall> balls);
  template <class T>
  bool try_balls(Arithmetic<T>& arithmetic, std::span<const LiuBall> balls);
  template <class T>
  void test_fold(const CandidateSet<T>& candidates, const LiuBall& ball);

  double first_reach(std::span<const std::uint32_t> slots) const;

  LiuTask task_;
  Arithmetic<float> floats_;
  Arithmetic<double> doubles_;
  Arithmetic<std::int64_t> integers_;
  Neighbours neighbours_;
  std::vector<AzimuthGapTest::Entry> azimuths_;
  FoldScratch fold_;
  FoldEmission emission_;
  std::vector<std::uint32_t> pending_;  ///< Queries that the current reach did not do for.
  std::vector<LiuBall> balls_;          ///< Balls of the current group.
  std::vector<UnprovenQuery> unproven_;
  double reach_sum_ = 0.0;  ///< Of the distances of last neighbours in the current group.
  std::size_t measured_ = 0;
};

}  // namespace arris
