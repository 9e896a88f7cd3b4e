#pragma once
/// @file Runs arris's own method for the queries of one bucket after the other; one runner per chunk of buckets.

#include <cstdint>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "features/arris/arris_parameters.h"
#include "features/arris/point_analysis.h"
#include "features/contour/tile_contours.h"
#include "features/neighbourhood/ball_search.h"
#include "features/neighbourhood/neighbour_search.h"
#include "features/neighbourhood/point_tree.h"

namespace arris {

/// What all runners of a tile share. Read only.
struct ArrisTask {
  const PointTree& tree;
  const LatticeBox& covered;
  const ArrisParameters& parameters;
  const Lattice& lattice;
  double max_reach = 0.0;    ///< R_max, steps.
  std::uint64_t max_d2 = 0;  ///< floor(R_max²).
};

/// Not thread-safe; make one per chunk.
class ArrisRunner {
 public:
  struct Found {
    std::uint32_t slot;
    ContourRecord record;
  };

  explicit ArrisRunner(const ArrisTask& task);

  /// `slots`: queries that are close together, in tree order.
  void run(std::span<const std::uint32_t> slots);

  std::vector<UnprovenQuery> take_unproven() { return std::move(unproven_); }
  const std::vector<Found>& found() const { return found_; }
  const std::vector<std::uint32_t>& isolated() const { return isolated_; }

 private:
  class Balls;

  void use_neighbours(std::uint32_t slot, const Neighbours& neighbours);
  template <class T>
  void test(const CandidateSet<T>& candidates, const BallQuery<T>& query, const Ball& ball);
  void record(const Ball& ball, const PointContour& contour);
  std::uint8_t side_of(std::uint32_t slot, const FoldLine& line) const;
  bool seen(std::uint32_t slot, double reach) const;
  void leave_unproven(std::uint32_t slot, double reach);

  ArrisTask task_;
  NeighbourSearch neighbour_search_;
  BallSearch ball_search_;
  SharedBalls second_balls_, third_balls_;  ///< Of the group whose first balls are being tested.
  std::vector<Ball> balls_;
  std::vector<double> spacings_;  ///< Of the balls' points, steps.
  std::vector<double> sorted_spacings_;
  BallPoints points_[3];
  AnalysisScratch scratch_;
  std::vector<Found> found_;
  std::vector<std::uint32_t> isolated_;
  std::vector<UnprovenQuery> unproven_;
};

}  // namespace arris
