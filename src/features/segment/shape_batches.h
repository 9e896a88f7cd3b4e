#pragma once
/// @file Collects neighbourhoods into batches of equal size and fits their planes when a batch is full.

#include <array>
#include <cstdint>
#include <memory>

#include "features/neighbourhood/packed_neighbours.h"
#include "features/segment/median_plane.h"
#include "features/segment/pending_neighbourhoods.h"
#include "features/segment/robust_plane.h"
#include "features/segment/tile_neighbourhoods.h"

namespace arris {

/// Points on a line define no plane: l1 must be at least this share of l2.
constexpr double kLeastWidth = 1e-6;

/// Not thread-safe.
class ShapeBatches {
 public:
  explicit ShapeBatches(const PlaneWeights& weights) : weights_(weights) {}

  /// Calls use(slot, shape, has normal) once for every slot, now or later, at the latest in flush().
  /// @param found  leaves other memory there. @param count  of the nearest of those found, 3 to kMostNeighbours.
  template <class Use>
  void add(std::uint32_t slot, PackedNeighbours& found, std::size_t count, Use&& use) {
    Size& size = size_of(count);
    size.plain.add(slot, found);
    if (size.plain.full()) fit_plain(size, use);
  }

  template <class Use>
  void flush(Use&& use) {
    for (auto& size : sizes_) {
      if (!size) continue;
      if (size->plain.lanes() > 0) fit_plain(*size, use);
      if (size->robust.lanes() > 0) fit_robust(*size, use);
    }
  }

 private:
  struct Size {
    explicit Size(std::size_t neighbours) : plan(neighbours), plain(neighbours), robust(neighbours) {}
    MedianPlan plan;
    PendingNeighbourhoods plain, robust;
  };

  Size& size_of(std::size_t neighbours) {
    if (!sizes_[neighbours]) sizes_[neighbours] = std::make_unique<Size>(neighbours);
    return *sizes_[neighbours];
  }

  template <class Use>
  static void put(const PlaneBatch& planes, std::size_t lane, std::uint32_t slot, Use& use) {
    const PointShape shape{static_cast<float>(planes.nx[lane]), static_cast<float>(planes.ny[lane]),
                           static_cast<float>(planes.nz[lane]), static_cast<float>(planes.variation[lane])};
    use(slot, shape, planes.width[lane] > kLeastWidth);
  }

  /// Where all points are inliers of the plain plane, weights would change nothing.
  template <class Use>
  void fit_plain(Size& size, Use& use) {
    PlaneBatch planes;
    size.plain.lay_out(batch_);
    fit_plain_planes(batch_, planes);
    const NeighbourhoodBatch::Row means = batch_.mean_distance;  // The batch may serve others before the loop ends.
    for (std::size_t lane = 0; lane < size.plain.lanes(); ++lane) {
      const double limit = weights_.inlier_steps > 0.0 ? weights_.inlier_steps / means[lane] : kInlierShare;
      if (planes.farthest[lane] <= limit) {
        put(planes, lane, size.plain.slot(lane), use);
        continue;
      }
      size.robust.add(size.plain, lane);
      if (size.robust.full()) fit_robust(size, use);
    }
    size.plain.clear();
  }

  template <class Use>
  void fit_robust(Size& size, Use& use) {
    PlaneBatch planes;
    size.robust.lay_out(batch_);
    fit_robust_planes(batch_, size.plan, weights_, planes);
    for (std::size_t lane = 0; lane < size.robust.lanes(); ++lane) put(planes, lane, size.robust.slot(lane), use);
    size.robust.clear();
  }

  PlaneWeights weights_;
  NeighbourhoodBatch batch_;  ///< Of what is being fitted.
  std::array<std::unique_ptr<Size>, kMostNeighbours + 1> sizes_;
};

}  // namespace arris
