#pragma once
/// @file Runs Zheng et al.'s method, literally, for the queries of one bucket after the other; one runner per thread.

#include <cstdint>
#include <span>
#include <vector>

#include "features/planar/labelled_group.h"
#include "features/zheng/surface_projection.h"
#include "features/zheng/zheng_task.h"

namespace arris {

/// Not thread-safe; make one per thread.
class ZhengRunner {
 public:
  explicit ZhengRunner(const ZhengTask& task) : task_(task) {}

  /// `slots`: queries that are close together, in tree order.
  void run(std::span<const std::uint32_t> slots);

  const FoundRecords& found() const { return found_; }
  std::vector<UnprovenQuery> take_unproven() { return {}; }  ///< The halo covers every support.

 private:
  struct Query {
    std::uint32_t label, slot;
    ContourRecord record;
  };
  /// Queries of one supervoxel.
  using Run = std::span<Query>;

  void test_borders(Run run, const LabelledPart& own, const ClosedBox& box);
  bool near_neighbour(const LabelledPart& own, const Vector3& at, double distance) const;
  bool may_touch(const LabelledPart& own, const LabelledPart& other, double& angle_deg) const;
  bool any_may_touch();
  void test_contacts(Run run, const LabelledPart& own, const LabelledPart& other, double angle_deg);
  template <class Test>
  void for_each_run(Test&& test);

  ZhengTask task_;
  LabelledGroup group_;
  SurfaceProjection surface_;
  std::vector<Query> queries_;
  FoundRecords found_;
};

}  // namespace arris
