#pragma once
/// @file Which points of a labelled cloud lie at a boundary between labels.

#include <cstdint>
#include <span>
#include <vector>

#include "evaluate/labelled_point.h"

namespace arris::evaluate {

/// Indices, ascending, of the judged points that have a judged point of another label within `radius` (inclusive, with
/// kToleranceSlack). Label 0 is a label like the others.
///
/// Laws: (1) neither the order of the points nor the number of threads matters; (2) only which labels are equal
/// matters, not their values; (3) if a is a boundary point because of b, b is one because of a.
///
/// O(n log n), and for the points in cells of side `radius` near which labels differ the points of other labels there.
/// 16 bytes per point. Throws ConfigError if the radius is not above 0, or less than a millionth of the extent.
///
/// @param points  below 2^32. @param label  &LabelledPoint::segment or &LabelledPoint::face.
std::vector<std::uint32_t> find_label_boundary(std::span<const LabelledPoint> points,
                                               std::uint32_t LabelledPoint::*label, double radius);

}  // namespace arris::evaluate
