#pragma once
/// @file Everything that is decided before a point is moved: survey, parameters, memory, tiles, disk.

#include <memory>

#include "io/point_source.h"
#include "pipeline/colour_source.h"
#include "pipeline/extract.h"
#include "pipeline/tile_job.h"

namespace arris::pipeline {

struct JobPlan : TileJob {
  ContourParameters method;               ///< Resolved.
  SupervoxelScale scale;                  ///< Of methods by supervoxels.
  std::unique_ptr<ColourSource> colours;  ///< That voxels get; none: nullptr.
  std::uint64_t voxel_temp_bytes = 0;  ///< On disk, of the voxels: likely at first; what the store takes, once it is.
};

/// R_max, where the user gives none, in units of the survey's spacing. Wide enough for scans whose density falls with
/// the square of the range: spacing may grow 20-fold from where most points are to where the least are.
constexpr double kMaxRadiusSpacings = 120.0;

/// How far neighbours are looked for, where the user says nothing. @param spacing  0: the survey's.
double resolve_max_radius(const tiling::Survey& survey, double spacing, double at_least);

/// Survey and parameters. Reads the inputs once (twice for floating-point coordinates). Throws BudgetError if memory
/// cannot do for any scan.
JobPlan survey_job(io::InputSet& inputs, const ExtractRequest& request, ProgressSink& progress,
                   const CancelToken& cancel);

/// Tiles of points, from plan.memory. Throws BudgetError if memory or disk cannot do.
void plan_job_tiles(JobPlan& plan, io::InputSet& inputs, const ExtractRequest& request, ProgressSink& progress,
                    const CancelToken& cancel);

/// Copies what a plan decided into a report.
void describe_plan(const JobPlan& plan, const io::InputSet& inputs, const ExtractRequest& request,
                   ExtractReport& report);

}  // namespace arris::pipeline
