#pragma once
/// @file How segments and faces overlap, and the measures that follow from the overlaps alone.
///
/// N points carry both labels; S are segments, g faces, |S| and |g| their points, |S ∩ g| the points of an overlap. All
/// sums are over whole numbers or in a fixed order: the same points give the same bits in any order. No measure is
/// defined for N = 0.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "evaluate/labelled_point.h"

namespace arris::evaluate {

struct LabelOverlap {
  std::uint32_t segment = 0, face = 0;
  std::uint64_t points = 0;  ///< At least 1.
  friend bool operator==(const LabelOverlap&, const LabelOverlap&) = default;
};

/// Of the judged points that have a segment; ascending by segment, then face. O(n log n), 8 bytes per point.
std::vector<LabelOverlap> count_overlaps(std::span<const LabelledPoint> points);
/// Of all points with finite coordinates: 0 is a label like any other.
std::vector<LabelOverlap> count_all_overlaps(std::span<const LabelledPoint> points);

struct OverlapMeasures {
  std::uint64_t points = 0;    ///< N.
  std::uint64_t segments = 0;  ///< With at least one of the points.
  std::uint64_t faces = 0;     ///< Likewise.
  /// (1/N) [sum over g of the |S| of all S with |S ∩ g| > 0.05 |S|] - 1, at least 0 where every segment overlaps some
  /// face by that much: how much faces grow if all segments that reach into them are added (Levinshtein et al. 2009
  /// with the 5 % rule of Papon et al. 2013).
  std::optional<double> undersegmentation;
  /// (1/N) sum over g and S that overlap of min(|S ∩ g|, |S \ g|), [0, 1]: the same without a threshold, and without
  /// punishing large segments for a small leak (Neubert & Protzel 2012).
  std::optional<double> corrected_undersegmentation;
  /// (1/N) sum over S of max over g of |S ∩ g|, (0, 1]: accuracy if each segment is given its best face; also called
  /// purity. 1 - this is the "corrected undersegmentation error" of Van den Bergh et al.
  std::optional<double> achievable_accuracy;
  /// Adjusted Rand index (Hubert & Arabie 1985), at most 1; about 0 for labels by chance; 1 if both partitions are
  /// trivial in the same way.
  std::optional<double> adjusted_rand;
  /// Conditional entropies, bits: of the segment where the face is known (surfaces split), and of the face where the
  /// segment is known (surfaces joined). Their sum is the variation of information (Meila 2007).
  std::optional<double> information_split, information_joined;
};

/// @param overlaps  as from count_overlaps(). O(n log n) for n overlaps.
OverlapMeasures measure_overlaps(std::span<const LabelOverlap> overlaps);

}  // namespace arris::evaluate
