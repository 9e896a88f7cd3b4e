#pragma once
/// @file Collects what all queries of a tile say of its points, in dense arrays that any thread may add to.

#include <cstdint>

#include "core/pages.h"
#include "core/tile_points.h"
#include "features/contour/contour_record.h"
#include "features/liu/fold_test.h"
#include "features/neighbourhood/azimuth_gap.h"
#include "features/neighbourhood/point_tree.h"

namespace arris {

/// Slots are indices in tree order. 17 bytes per point (5 without folds). Adding is thread-safe: fold emissions are
/// commutative atomic updates with the semantics of combine(), all else has one writer per slot.
class ContourAccumulator {
 public:
  ContourAccumulator(std::size_t points, bool folds);

  void add_gap(std::size_t slot, const GapResult& gap);
  void add_fold(std::size_t slot, float strength, float angle_deg);
  void add_isolated(std::size_t slot);

  struct Outcome {
    ContourRecords records;      ///< Ascending ids; duplicates expanded.
    std::uint64_t isolated = 0;  ///< Duplicates count.
  };
  Outcome finish(const PointTree& tree, const TilePoints& tile) const;

 private:
  ContourRecord record(std::size_t slot) const;

  PageVector<std::uint8_t> marks_;
  PageVector<float> gap_deg_;
  PageVector<std::uint32_t> votes_;
  /// Bits of the strength above the complement of the bits of the angle: the maximum is the strongest, and of those the
  /// sharpest.
  PageVector<std::uint64_t> strongest_;
};

}  // namespace arris
