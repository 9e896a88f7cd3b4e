#pragma once
/// @file Runs arris's own method for the queries of one bucket after the other; one runner per thread.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "core/pages.h"
#include "features/arris/arris_parameters.h"
#include "features/arris/ball_shape.h"
#include "features/arris/point_analysis.h"
#include "features/arris/scatter.h"
#include "features/contour/tile_contours.h"
#include "features/neighbourhood/ball_search.h"
#include "features/neighbourhood/distance_row.h"
#include "features/neighbourhood/neighbour_search.h"
#include "features/neighbourhood/point_tree.h"
#include "features/neighbourhood/spacing_batch.h"

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

/// Not thread-safe; make one per thread.
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
  const PageVector<Found>& found() const { return found_; }
  const std::vector<std::uint32_t>& isolated() const { return isolated_; }

 private:
  class Balls;

  /// Points whose spacings are worked out together.
  template <class Key>
  struct Waiting {
    SpacingBatch<Key> batch;
    std::array<std::uint32_t, SpacingBatch<Key>::kCount> slots;
    std::size_t count = 0;
  };

  void use_distances(std::uint32_t slot, const DistanceRow& row);
  template <class Key>
  void wait_for_spacing(Waiting<Key>& waiting, std::uint32_t slot, const DistanceRow::Keys<Key>& row);
  template <class Key>
  void use_spacings(Waiting<Key>& waiting);
  void use_spacing(std::uint32_t slot, double density, double last_d2);
  template <class T>
  void test_group(const CandidateSet<T>& candidates, std::span<const BallQuery<T>> queries,
                  std::span<const Ball> balls);
  void look_for_scatter(std::span<const std::size_t> indices);
  void test(const Ball& ball, const PointProspects& prospects, const BallPoints& first);
  void record(const Ball& ball, const PointContour& contour);
  std::uint8_t side_of(std::uint32_t slot, const FoldLine& line) const;
  bool seen(std::uint32_t slot, double reach) const;
  void leave_unproven(std::uint32_t slot, double reach);

  ArrisTask task_;
  NearestSearch<DistanceRow> neighbour_search_;
  Waiting<std::int32_t> narrow_;
  Waiting<std::int64_t> wide_;
  BallSearch ball_search_;
  SharedBalls second_balls_, third_balls_;  ///< Of the group whose first balls are being tested.
  std::vector<Ball> balls_;
  std::vector<double> spacings_;       ///< Of the balls' points, steps.
  std::vector<BallMeasure> measures_;  ///< Of the balls of a group, then of the near balls of some.
  std::vector<BallShape> shapes_;
  std::vector<PointProspects> prospects_;
  std::vector<std::size_t> left_;  ///< Balls of the group that may be contours.
  BallPoints first_points_[8];     ///< Of as many points as are tested for scatter together.
  BallPoints points_[2];           ///< Of the larger balls of one point.
  ScatterScratch scatter_scratch_;
  AnalysisScratch scratch_;
  PageVector<Found> found_;
  std::vector<std::uint32_t> isolated_;
  std::vector<UnprovenQuery> unproven_;
};

}  // namespace arris
