#pragma once
/// @file Collects neighbourhoods into batches of equal size and fits their planes when a batch is full.

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>

#include "features/neighbourhood/nearest_select.h"
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
  /// @param count  of the nearest of those found, 3 to kMostNeighbours.
  template <class Use>
  void add(std::uint32_t slot, const Neighbours& found, std::size_t count, Use&& use) {
    Size& size = size_of(count);
    const std::size_t lane = size.plain.batch.lanes++;
    size.plain.slot[lane] = slot;
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      size.plain.batch.x[i][lane] = found.dx[i];
      size.plain.batch.y[i][lane] = found.dy[i];
      size.plain.batch.z[i][lane] = found.dz[i];
      sum += std::sqrt(found.d2[i]);
    }
    size.plain.batch.mean_distance[lane] = sum / static_cast<double>(count);
    if (lane + 1 == kBatchLanes) fit_plain(size, use);
  }

  template <class Use>
  void flush(Use&& use) {
    for (auto& size : sizes_) {
      if (!size) continue;
      if (size->plain.batch.lanes > 0) fit_plain(*size, use);
      if (size->robust.batch.lanes > 0) fit_robust(*size, use);
    }
  }

 private:
  struct Pending {
    NeighbourhoodBatch batch;
    std::array<std::uint32_t, kBatchLanes> slot{};
  };
  struct Size {
    explicit Size(std::size_t neighbours) : plan(neighbours) {
      for (Pending* pending : {&plain, &robust}) {
        pending->batch.neighbours = neighbours;
        pending->batch.mean_distance.fill(1.0);
      }
    }
    MedianPlan plan;
    Pending plain, robust;
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
    NeighbourhoodBatch& from = size.plain.batch;
    fit_plain_planes(from, planes_);
    for (std::size_t lane = 0; lane < from.lanes; ++lane) {
      const double limit =
          weights_.inlier_steps > 0.0 ? weights_.inlier_steps / from.mean_distance[lane] : kInlierShare;
      if (planes_.farthest[lane] <= limit) {
        put(planes_, lane, size.plain.slot[lane], use);
        continue;
      }
      NeighbourhoodBatch& to = size.robust.batch;
      const std::size_t at = to.lanes++;
      size.robust.slot[at] = size.plain.slot[lane];
      for (std::size_t i = 0; i < from.neighbours; ++i) {
        to.x[i][at] = from.x[i][lane];
        to.y[i][at] = from.y[i][lane];
        to.z[i][at] = from.z[i][lane];
      }
      to.mean_distance[at] = from.mean_distance[lane];
      if (to.lanes == kBatchLanes) fit_robust(size, use);
    }
    from.lanes = 0;
  }

  template <class Use>
  void fit_robust(Size& size, Use& use) {
    PlaneBatch planes;
    fit_robust_planes(size.robust.batch, size.plan, weights_, planes);
    for (std::size_t lane = 0; lane < size.robust.batch.lanes; ++lane) put(planes, lane, size.robust.slot[lane], use);
    size.robust.batch.lanes = 0;
  }

  PlaneWeights weights_;
  PlaneBatch planes_;
  std::array<std::unique_ptr<Size>, kMostNeighbours + 1> sizes_;
};

}  // namespace arris
