#pragma once
/// @file Leaves out points near the ground, as Yu et al. do before they look for roofs.

#include <memory>
#include <vector>

#include "core/cancel.h"
#include "core/progress.h"
#include "features/ground/ground_model.h"
#include "io/point_source.h"

namespace arris::pipeline {

/// The ground of the inputs from the points that are classified as ground (class 2; PLY by its classification), in one
/// pass. What the inputs exclude plays no part: --only-class 6 leaves the ground where it is. Memory: GroundModel.
/// Throws InputError if no point is ground.
GroundModel read_ground(io::InputSet& inputs, ProgressSink& progress, const CancelToken& cancel);

/// Excludes points less than min_height (data units) above the ground. Points that are not finite are left alone, so
/// that they count as such. About 30 ns a point and pass.
io::PointFilter above_ground(std::shared_ptr<const GroundModel> ground, double min_height,
                             const std::vector<io::SourceInfo>& sources);

}  // namespace arris::pipeline
