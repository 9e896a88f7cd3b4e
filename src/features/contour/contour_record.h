#pragma once
/// @file What the methods say of a point, and how two statements about the same point combine.

#include <array>
#include <cstdint>

#include "core/pages.h"

namespace arris {

/// A partial result for one point. Combining is commutative and associative, so the order in which tiles are processed
/// and merged cannot matter.
struct ContourRecord {
  std::uint64_t id = 0;
  std::uint8_t classes = 0;     ///< EdgeClassBit flags.
  std::uint32_t votes = 0;      ///< Balls that emitted this point as fold point; adds up.
  float gap_deg = 0.0F;         ///< Largest azimuth gap, degrees, of a boundary point; maximum wins.
  float fold_strength = 0.0F;   ///< C_f1 / C'_f1 of the strongest emitting ball (>= 1), 0 if none; maximum wins ...
  float fold_angle_deg = 0.0F;  ///< ... and takes its interior angle with it (ties: the smaller angle).
  float score = 0.0F;           ///< EdgeScore, [0, 1], if the method gives one per point (arris); maximum wins.
  /// From the point to the nearest point of the refined contour, data units; goes with the score.
  std::array<float, 3> to_edge{0.0F, 0.0F, 0.0F};

  friend bool operator==(const ContourRecord&, const ContourRecord&) = default;
};

/// Of a tile: there may be as many as points.
using ContourRecords = PageVector<ContourRecord>;

/// Folds `other` into `record`; the ids must be equal.
inline void combine(ContourRecord& record, const ContourRecord& other) {
  record.classes = static_cast<std::uint8_t>(record.classes | other.classes);
  record.votes += other.votes;
  if (other.gap_deg > record.gap_deg) record.gap_deg = other.gap_deg;
  if (other.score > record.score) {
    record.score = other.score;
    record.to_edge = other.to_edge;
  }
  if (other.fold_strength > record.fold_strength ||
      (other.fold_strength == record.fold_strength && other.fold_strength > 0.0F &&
       other.fold_angle_deg < record.fold_angle_deg)) {
    record.fold_strength = other.fold_strength;
    record.fold_angle_deg = other.fold_angle_deg;
  }
}

}  // namespace arris
