#pragma once
/// @file Whether two neighbours may be in one segment.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "features/segment/segment_parameters.h"
#include "features/segment/tile_neighbourhoods.h"

namespace arris {

/// Symmetric: alike(a, b) == alike(b, a), bit for bit.
class Likeness {
 public:
  /// @param intensities  per slot, or empty.
  Likeness(const TileNeighbourhoods& points, std::span<const std::uint8_t> intensities,
           const SegmentParameters& parameters);

  void use_intensities(std::span<const std::uint8_t> of_slot) { intensities_ = of_slot; }

  /// One point beside many others. All must have a normal.
  class With {
   public:
    With(const Likeness& likeness, std::uint32_t a)
        : likeness_(likeness),
          a_(a),
          nx_(likeness.points_.shape(a).nx),
          ny_(likeness.points_.shape(a).ny),
          nz_(likeness.points_.shape(a).nz) {}
    /// |n . n'|.
    double alignment(std::uint32_t b) const {
      const PointShape& q = likeness_.points_.shape(b);
      return std::fabs(nx_ * q.nx + ny_ * q.ny + nz_ * q.nz);
    }
    bool alike(std::uint32_t b) const {
      return alignment(b) > likeness_.least_alignment_ && likeness_.same_material(a_, b);
    }

   private:
    const Likeness& likeness_;
    std::uint32_t a_;
    double nx_, ny_, nz_;
  };
  double alignment(std::uint32_t a, std::uint32_t b) const { return With(*this, a).alignment(b); }
  bool alike(std::uint32_t a, std::uint32_t b) const { return With(*this, a).alike(b); }
  bool same_material(std::uint32_t a, std::uint32_t b) const {
    return intensities_.empty() || std::abs(int{intensities_[a]} - int{intensities_[b]}) < step_;
  }

 private:
  const TileNeighbourhoods& points_;
  std::span<const std::uint8_t> intensities_;
  double least_alignment_;
  int step_;
};

}  // namespace arris
