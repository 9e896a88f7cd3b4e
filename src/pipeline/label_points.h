#pragma once
/// @file Passes over the inputs that ask every point for its supervoxel.

#include <memory>
#include <vector>

#include "core/cancel.h"
#include "core/progress.h"
#include "io/point_source.h"
#include "io/point_writer.h"
#include "merge/supervoxel_moments.h"
#include "pipeline/voxel_labels.h"
#include "tiling/lattice_mapper.h"

namespace arris::pipeline {

/// Adds all points that take part to their supervoxels' moments.
void sum_moments(io::InputSet& inputs, const tiling::LatticeMapper& mapper, VoxelLabels labels,
                 merge::SupervoxelMoments& moments, ProgressSink& progress, const CancelToken& cancel);

/// Writes every record with its label as one uint32 column (0: the point took no part). Does not commit. Returns the
/// number of points.
std::uint64_t write_labels(io::InputSet& inputs, const tiling::LatticeMapper& mapper, VoxelLabels labels,
                           std::vector<std::unique_ptr<io::KeptPointWriter>>& writers, ProgressSink& progress,
                           const CancelToken& cancel);

}  // namespace arris::pipeline
