#pragma once
/// @file Runs the method for the queries of one bucket after the other; one runner per chunk of buckets.

#include <cstdint>
#include <span>
#include <vector>

#include "features/liu/contour_accumulator.h"
#include "features/liu/liu_method.h"
#include "features/liu/liu_settings.h"
#include "features/neighbourhood/ball_search.h"
#include "features/neighbourhood/neighbour_search.h"
#include "features/neighbourhood/point_tree.h"

namespace arris {

/// What all runners of a tile share. Read only, but for the accumulator.
struct LiuTask {
  const PointTree& tree;
  const LatticeBox& covered;
  const LiuSettings& settings;
  ContourAccumulator& results;
};

/// Not thread-safe; make one per chunk.
class LiuRunner {
 public:
  explicit LiuRunner(const LiuTask& task);

  /// `slots`: queries that are close together, in tree order.
  void run(std::span<const std::uint32_t> slots);

  std::vector<UnprovenQuery> take_unproven() { return std::move(unproven_); }

 private:
  void use_neighbours(std::uint32_t slot, const Neighbours& neighbours);
  bool proven(std::uint32_t slot, const Neighbours& neighbours, const FoldThresholds& fold);
  void test_boundary(std::uint32_t slot, const Neighbours& neighbours, const LocalSpacing& spacing);
  template <class T>
  void test_fold(const CandidateSet<T>& candidates, const BallQuery<T>& query, const Ball& ball);

  LiuTask task_;
  NeighbourSearch neighbour_search_;
  BallSearch ball_search_;
  std::vector<AzimuthGapTest::Entry> azimuths_;
  FoldScratch fold_;
  FoldEmission emission_;
  std::vector<Ball> balls_;                 ///< Balls of the current group ...
  std::vector<FoldThresholds> thresholds_;  ///< ... and what to test them for.
  std::vector<UnprovenQuery> unproven_;
};

}  // namespace arris
