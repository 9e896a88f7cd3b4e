#pragma once
/// @file Runs the method for the queries of one bucket after the other; one runner per thread.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "features/liu/contour_accumulator.h"
#include "features/liu/fold_screen.h"
#include "features/liu/liu_method.h"
#include "features/liu/liu_settings.h"
#include "features/liu/scale_batch.h"
#include "features/neighbourhood/ball_search.h"
#include "features/neighbourhood/neighbour_search.h"
#include "features/neighbourhood/point_tree.h"
#include "features/numerics/principal_frames.h"

namespace arris {

/// What all runners of a tile share. Read only, but for the accumulator.
struct LiuTask {
  const PointTree& tree;
  const LatticeBox& covered;
  const LiuSettings& settings;
  ContourAccumulator& results;
};

/// Not thread-safe; make one per thread.
class LiuRunner {
 public:
  explicit LiuRunner(const LiuTask& task);

  /// `slots`: queries that are close together, in tree order.
  void run(std::span<const std::uint32_t> slots);

  /// After the last run(): finishes what still waits.
  std::vector<UnprovenQuery> take_unproven() {
    test_boundaries();
    return std::move(unproven_);
  }

 private:
  struct Boundary {
    std::uint32_t slot = 0;
    LocalSpacing spacing;
    Neighbours neighbours;
  };
  struct Framed {
    const Ball* ball = nullptr;
    double points = 0.0;
  };

  /// Takes `neighbours` away if they wait for the boundary test, and leaves others of no meaning.
  void use_neighbours(std::uint32_t slot, Neighbours& neighbours);
  bool proven(std::uint32_t slot, const Neighbours& neighbours, const FoldThresholds& fold);
  /// Those that wait, eight at once.
  void test_boundaries();
  void test_boundary(const Boundary& tested, int k, const PrincipalFrame& frame);
  /// Balls that share their candidates. What cannot be a fold goes in two steps, each for eight balls at once: by the
  /// moments, then by the extents along the principal axes.
  template <class T>
  void test_folds(const CandidateSet<T>& candidates, std::span<const BallQuery<T>> queries,
                  std::span<const Ball> balls);
  template <class T>
  void test_framed(const CandidateSet<T>& candidates);
  template <class T>
  void test_fold(const CandidateSet<T>& candidates, const BallQuery<T>& query, const Ball& ball,
                 const PrincipalFrame& frame);

  LiuTask task_;
  NeighbourSearch neighbour_search_;
  BallSearch ball_search_;
  ScaleBatch scales_;
  std::array<Boundary, ScaleBatch::kCount> boundaries_;  ///< Queries that wait for the boundary test.
  std::size_t boundary_count_ = 0;
  std::vector<AzimuthGapTest::Entry> azimuths_;
  FoldScreen screen_;
  PrincipalFrames frames_;
  std::array<Framed, PrincipalFrames::kCount> framed_;  ///< Balls that wait for their frames.
  std::size_t framed_count_ = 0;
  FoldScratch fold_;
  FoldEmission emission_;
  std::vector<Ball> balls_;                 ///< Balls of the current group ...
  std::vector<FoldThresholds> thresholds_;  ///< ... and what to test them for.
  std::vector<UnprovenQuery> unproven_;
};

}  // namespace arris
