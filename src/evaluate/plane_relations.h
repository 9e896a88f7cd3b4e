#pragma once
/// @file Which planes are split over several segments, and which segments hold several planes.

#include <cstdint>
#include <span>

#include "evaluate/label_overlaps.h"

namespace arris::evaluate {

/// Groups of planes and segments that belong together, directly or by way of others, counted by how many there are of
/// each (planes first): 1:1, 1:M (a plane split), N:1 (planes joined), N:M (both), and what stands alone.
struct PlaneRelations {
  std::uint64_t one_to_one = 0, one_to_many = 0, many_to_one = 0, many_to_many = 0;
  std::uint64_t planes_alone = 0, segments_alone = 0;
  friend bool operator==(const PlaneRelations&, const PlaneRelations&) = default;
};

/// Sizes of a plane or segment by its number.
struct LabelSize {
  std::uint32_t label = 0;
  std::uint64_t points = 0;
};

/// A plane t and a segment s of those given belong together if |s ∩ t| >= |t| / 2 or |s ∩ t| >= |s| / 2.
/// @param overlaps  of labels that may be 0 or not given: these are passed over.
/// @param planes, segments  ascending by label, without 0. O(n log n).
PlaneRelations relate_planes(std::span<const LabelOverlap> overlaps, std::span<const LabelSize> planes,
                             std::span<const LabelSize> segments);

}  // namespace arris::evaluate
