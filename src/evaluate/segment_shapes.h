#pragma once
/// @file How round segments are.

#include <optional>
#include <span>

#include "evaluate/labelled_point.h"

namespace arris::evaluate {

/// Compactness: mean over the points of the ratio of the second to the first half-axis of their segment, sqrt(l2 / l1)
/// with the eigenvalues l1 >= l2 >= l3 of the covariance of its points, [0, 1]. A disc, a square or a ball has 1, a
/// strip a times as long as wide 1/a. Segments of less than 3 points, or without extent, do not count; empty if none
/// does. Judged points with a segment only. O(n log n), 8 bytes per point; the same for any number of threads.
/// @param points  below 2^32.
std::optional<double> mean_compactness(std::span<const LabelledPoint> points);

}  // namespace arris::evaluate
