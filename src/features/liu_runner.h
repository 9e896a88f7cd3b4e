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

/// Not thread-safe; make one per chunk. Candidates are gathered once for all queries of a bucket; a query whose support is wider than
/// what was gathered is run again by itself with what it needs. How far a gathering reaches is guessed from the bucket before and
/// decides only the speed.
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
  struct Retry {
    std::uint32_t slot;
    double reach;
  };

  void run_group(std::span<const std::uint32_t> slots, const GatherReach& reach);
  template <class T>
  bool try_group(Arithmetic<T>& arithmetic, const ClosedBox& box, std::span<const std::uint32_t> slots, const GatherReach& reach);
  template <class T>
  void run_query(Arithmetic<T>& arithmetic, std::uint32_t slot);
  template <class T>
  bool find_neighbours(Arithmetic<T>& arithmetic, std::uint32_t slot);
  bool proven(std::uint32_t slot, const FoldThresholds& fold);
  void test_boundary(std::uint32_t slot, const LocalSpacing& spacing);
  template <class T>
  void test_fold(const Arithmetic<T>& arithmetic, std::uint32_t slot, const FoldThresholds& thresholds);
  GatherReach expected_reach(std::span<const std::uint32_t> slots) const;

  LiuTask task_;
  Arithmetic<float> floats_;
  Arithmetic<double> doubles_;
  Arithmetic<std::int64_t> integers_;
  Neighbours neighbours_;
  std::vector<AzimuthGapTest::Entry> azimuths_;
  FoldScratch fold_;
  FoldEmission emission_;
  std::vector<Retry> retries_;
  std::vector<UnprovenQuery> unproven_;
  // Sums over the queries of the current bucket, from which the next bucket's reach is guessed.
  double near_sum_ = 0.0;
  double far_sum_ = 0.0;
  std::size_t measured_ = 0;
};

}  // namespace arris
