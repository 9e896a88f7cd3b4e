#pragma once
/// @file The improved reading of Zheng et al.'s method: supervoxels propose, their points decide.

#include <cstdint>
#include <span>
#include <vector>

#include "features/neighbourhood/ball_search.h"
#include "features/planar/labelled_group.h"
#include "features/zheng/seam_judge.h"
#include "features/zheng/surface_projection.h"
#include "features/zheng/zheng_task.h"

namespace arris {

/// Seams are healed: a point is a border only if it is alpha-exposed among its own supervoxel and those that continue
/// its surface. Contacts are proposed by all points near a supervoxel that does not continue the surface, and by
/// supervoxels that are no planes. What is proposed is judged on the points in a ball (seam_judge.h). Not thread-safe;
/// make one per thread.
class HealedRunner {
 public:
  explicit HealedRunner(const ZhengTask& task);

  /// `slots`: queries that are close together, in tree order.
  void run(std::span<const std::uint32_t> slots);

  const FoundRecords& found() const { return found_; }
  std::vector<UnprovenQuery> take_unproven() { return {}; }  ///< The halo covers every support.

 private:
  class Balls;
  struct Query {
    std::uint32_t label, slot;
  };
  struct Proposal {
    std::uint32_t slot = 0;
    double spacing = 0.0;      ///< That the supervoxel counts with, steps.
    double least_share = 0.0;  ///< Smaller balls are not worth asking for.
    double share = 1.0;        ///< Of the full ball, the one that is asked for now.
    bool contact = false, bent = false, border = false, judged = false;
  };
  /// A supervoxel beside the one that is asked about.
  struct Beside {
    const LabelledPart* part;
    bool continues;  ///< The same surface goes on.
    bool bends;      ///< Perhaps at an angle.
  };

  void propose(std::span<const Query> run, const LabelledPart& own, const ClosedBox& box);
  Beside beside(const LabelledPart& own, const LabelledPart& other, const ZhengLengths& lengths) const;
  void judge_all();
  template <class T>
  void judge(const CandidateSet<T>& candidates, const BallQuery<T>& query, const Ball& ball);
  void record(std::uint32_t slot, const Proposal& proposal, const PointContour& contour);

  ZhengTask task_;
  LabelledGroup group_;
  SurfaceProjection surface_;
  BallSearch ball_search_;
  SharedBalls wide_balls_;
  BallPoints points_[2];
  RimScratch scratch_;
  std::vector<Query> queries_;
  std::vector<Beside> beside_;
  std::vector<Ball> balls_;
  std::vector<Proposal> proposals_;
  FoundRecords found_;
};

}  // namespace arris
