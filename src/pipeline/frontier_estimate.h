#pragma once
/// @file How large the frontier of segments will be, from some parts of the scan.

#include <cstdint>
#include <span>

#include "features/segment/segment_parameters.h"
#include "pipeline/cell_sample.h"

namespace arris::pipeline {

/// Cells of kFrontierCellSpacings and of kSmallFrontierCellSpacings.
struct FrontierSamples {
  const CellSample& large;
  const CellSample& small;  ///< For where the scan is dense.
};

/// Grows segments in the cells, each as if it were all there is: noise, vegetation and the order of the points decide,
/// which no parameter tells. The frontier grows where points are nearer to each other than the noise allows: how many
/// are so dense the survey knows, so that it does not matter how many of the cells drawn are.
/// @param intensities  by point id, or empty. @return bytes on disk per point of the scan.
double frontier_bytes_per_point(const FrontierSamples& samples, std::span<const std::uint8_t> intensities,
                                const tiling::Survey& survey, const SegmentParameters& parameters);

/// If every point were on the frontier.
double most_frontier_bytes_per_point(const SegmentParameters& parameters);

/// Points to draw of a scan: few enough to take no time.
double frontier_sample(std::uint64_t points);
/// Segments and their insides must fit into a cell.
constexpr double kFrontierCellSpacings = 64.0;
constexpr double kSmallFrontierCellSpacings = 16.0;

}  // namespace arris::pipeline
