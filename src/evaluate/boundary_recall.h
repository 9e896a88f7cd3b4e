#pragma once
/// @file How well the boundaries of a segmentation follow those of the truth.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "evaluate/labelled_point.h"

namespace arris::evaluate {

/// Shares in [0, 1]; empty where there are no boundary points to take the share of.
struct BoundaryAgreement {
  double tolerance = 0.0;           ///< Data units.
  std::optional<double> recall;     ///< Of the truth's boundary points, with one of the segmentation within tolerance.
  std::optional<double> precision;  ///< Of the segmentation's boundary points, with one of the truth within tolerance.
};

/// Boundary recall as in Papon et al. (CVPR 2013), over points instead of pixels, and its counterpart. Supervoxels have
/// boundaries inside of surfaces too, so their precision says little; that of segments should be high.
/// @param truth, segmentation  indices into `points`, see find_label_boundary(). @param tolerances  each > 0, finite.
/// O((n + m) log(n + m)), about 30 bytes per boundary point. Runs in parallel; the result does not depend on threads.
std::vector<BoundaryAgreement> compare_boundaries(std::span<const LabelledPoint> points,
                                                  std::span<const std::uint32_t> truth,
                                                  std::span<const std::uint32_t> segmentation,
                                                  std::span<const double> tolerances);

}  // namespace arris::evaluate
