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

/// What a pass works with; all must outlive it.
struct LabelPass {
  const tiling::LatticeMapper& mapper;
  VoxelLabels labels;
  ProgressSink& progress;
  const CancelToken& cancel;
};

/// Adds all points that take part to their supervoxels' moments.
void sum_moments(io::InputSet& inputs, const LabelPass& pass, merge::SupervoxelMoments& moments);

/// Writes every record with its label as one uint32 column (0: the point took no part). Does not commit. Returns the
/// number of points.
std::uint64_t write_labels(io::InputSet& inputs, const LabelPass& pass,
                           std::vector<std::unique_ptr<io::KeptPointWriter>>& writers);

}  // namespace arris::pipeline
