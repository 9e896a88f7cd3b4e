#pragma once
/// @file Runs the contours of supervoxels for the queries of one bucket after the other; one runner per chunk.

#include <cstdint>
#include <span>
#include <vector>

#include "features/alpha_exposed.h"
#include "features/labelled_group.h"
#include "features/point_tree.h"
#include "features/supervoxel_frame.h"
#include "features/tile_contours.h"
#include "features/zheng_settings.h"

namespace arris {

/// What all runners of a tile share. Read only.
struct ZhengTask {
  const PointTree& tree;
  std::span<const std::uint32_t> labels;  ///< In the tree's order.
  const SupervoxelTable& table;
  const ZhengSettings& settings;
};

/// Not thread-safe; make one per chunk.
class ZhengRunner {
 public:
  explicit ZhengRunner(const ZhengTask& task) : task_(task) {}

  /// `slots`: queries that are close together, in tree order.
  void run(std::span<const std::uint32_t> slots);

  struct Found {
    std::uint32_t slot;
    ContourRecord record;
  };
  const std::vector<Found>& found() const { return found_; }
  std::vector<UnprovenQuery> take_unproven() { return {}; }  ///< The halo covers every support.

 private:
  struct Query {
    std::uint32_t label, slot;
    ContourRecord record;
  };
  /// Queries of one supervoxel.
  using Run = std::span<Query>;

  void find_borders(const ClosedBox& box);
  void test_borders(Run run, const LabelledPart& own);
  void project(const LabelledPart& own, const SupervoxelFrame& frame);
  double exposure_deg(const LabelledPart& own, const SupervoxelFrame& frame, const Vector3& at, double alpha);
  bool near_neighbour(const LabelledPart& own, const Vector3& at, double distance) const;
  void find_contacts(const ClosedBox& box);
  void test_contacts(Run run, const LabelledPart& own, const LabelledPart& other, double angle_deg);
  template <class Test>
  void for_each_run(Test&& test);

  ZhengTask task_;
  LabelledGroup group_;
  AlphaExposure exposed_;
  PlaneNeighbours neighbours_;
  std::vector<double> a_, b_, w_;  ///< Of the points of one part, in the frame of its supervoxel.
  std::vector<Query> queries_;
  std::vector<Found> found_;
};

}  // namespace arris
