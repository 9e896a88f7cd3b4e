#include "pipeline/voxel_estimate.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/process_memory.h"
#include "features/supervoxel/voxel_features.h"
#include "pipeline/cluster_level.h"
#include "pipeline/coarser_voxels.h"
#include "pipeline/voxel_tile_walk.h"
#include "tiling/voxel_file.h"
#include "tiling/voxel_order.h"
#include "tiling/voxel_sums.h"
#include "tiling/voxel_tiles.h"

namespace arris::pipeline {
namespace {

/// Neighbours in the file are neighbours in space, but so much of the scan is met again when the table has been
/// emptied.
constexpr double kScannedTwice = 0.28;
constexpr double kColourBytes = sizeof(tiling::ColourSums);
double run_entry_bytes(bool colours) {
  return sizeof(tiling::VoxelSums) + (colours ? kColourBytes : 0.0);
}
double table_entry_bytes(bool colours) {
  return run_entry_bytes(colours) + tiling::kOrderBytes;
}
constexpr double kNormalBytes = 12.0;
/// Per supervoxel: plane, table, neighbours.
constexpr double kSupervoxelBytes = 120.0;

/// How many cubes of a side the points of a cell fill. Where cubes are larger than cells it is not known.
class CubesOfCell {
 public:
  CubesOfCell(int cell_level, std::int64_t side_steps) {
    const double sides = std::ldexp(1.0, cell_level) / static_cast<double>(side_steps);
    flat_ = 0.5 * (1.0 + sides * sides);  // A cell is seldom crossed from side to side.
  }
  double operator()(double n) const {
    constexpr double kTilted = 1.3;  // More than a flat surface crosses. Measured.
    return std::min(n, kTilted * flat_ * (1.0 - std::exp(-n / flat_)));
  }
  /// The share of them that have hardly any neighbours, so that no seed grows there.
  double lonely(std::uint64_t points) const {
    constexpr double kDense = 0.4;  // Points per face of a cube. Measured.
    const double density = static_cast<double>(points) / flat_ / kDense;
    return std::exp(-density * density);
  }

 private:
  double flat_;
};

/// @param parts  of the points, that fill cubes of their own.
double count_of_cubes(int cell_level, std::span<const tiling::CellClass> classes, std::int64_t side_steps,
                      std::uint64_t parts = 1) {
  const CubesOfCell cubes(cell_level, side_steps);
  double sum = 0.0;
  for (const auto& [points, cells] : classes)
    sum += static_cast<double>(cells * parts) * cubes(static_cast<double>(points) / static_cast<double>(parts));
  return sum;
}

/// The same for cubes that may be larger than the cells of the survey.
double count_of_large_cubes(const tiling::Survey& survey, std::int64_t side_steps) {
  const int level = static_cast<int>(std::ceil(std::log2(static_cast<double>(side_steps))));
  if (level <= survey.counts.level()) return count_of_cubes(survey.counts.level(), survey.classes, side_steps);
  const tiling::CellCounts coarse = survey.counts.coarsened(std::min(level, 30));
  return count_of_cubes(coarse.level(), coarse.classes(), side_steps);
}

/// Voxels of the scale that stand for voxels of the finer one that no seed reached.
double count_of_leftovers(const tiling::Survey& survey, const SupervoxelScale& finer, const SupervoxelScale& scale) {
  const int level = survey.counts.level();
  const CubesOfCell before(level, finer.voxel_steps), cubes(level, scale.voxel_steps);
  double sum = 0.0;
  for (const auto& [points, cells] : survey.classes)
    sum += static_cast<double>(cells) * before.lonely(points) * cubes(static_cast<double>(points));
  return sum;
}

/// Of all runs, where the table has room for fewer voxels than there are. What is scanned twice is in two of them as
/// far as both scans met the same voxels, unless the table still held it.
double run_entries(const tiling::Survey& survey, const SupervoxelScale& scale, double voxels, double table_entries) {
  const double of_both = count_of_cubes(survey.counts.level(), survey.classes, scale.voxel_steps, 2);
  return voxels + kScannedTwice * (of_both - voxels) * (1.0 - table_entries / voxels);
}

/// What all tiles have beside them.
double kept_bytes(const VoxelEstimate& estimate, const SupervoxelParameters& parameters) {
  return (sizeof(std::uint32_t) + 0.125) * estimate.voxels + cluster_bytes(parameters) * estimate.clusters;
}

double bytes_per_voxel(const VoxelEstimate& estimate, const SupervoxelParameters& parameters, bool colours) {
  return supervoxel_bytes_per_voxel(parameters.features, colours,
                                    likely_neighbours(estimate.voxels / std::max(1.0, estimate.blocks)));
}

/// Covered voxels of the largest tile.
double largest_tile(const tiling::Survey& survey, const SupervoxelScale& scale, const tiling::VoxelPlanRequest& plan,
                    double voxels) {
  if (voxels <= static_cast<double>(plan.max_voxels)) return voxels;
  const CubesOfCell voxels_of(survey.counts.level(), scale.voxel_steps);
  const VoxelGrid grid(scale.voxel_steps);
  const auto blocks = [&](const tiling::VisitBlock& visit) {
    double whole = 0.0;  // Of what came so far.
    survey.counts.for_each([&](const LatticeBox& cell, std::uint64_t points) {
      const double before = std::floor(whole);
      whole += voxels_of(static_cast<double>(points));
      const auto count = static_cast<std::uint64_t>(std::floor(whole) - before);
      const auto along = [&](int axis) {
        return grid.voxel_of(static_cast<std::int32_t>((cell.min[axis] + cell.max[axis]) / 2)) >> 3;
      };
      if (count > 0) visit({along(0), along(1), along(2)}, count);
    });
  };
  const tiling::TilePlan tiles = tiling::plan_voxel_tiles(blocks, plan);
  return std::min(voxels, static_cast<double>(tiles.largest_covered_points));
}

}  // namespace

double VoxelEstimate::lone() const {
  return lone_voxels(voxels, blocks);
}

double likely_voxels(const tiling::Survey& survey, const SupervoxelScale& scale) {
  return count_of_cubes(survey.counts.level(), survey.classes, scale.voxel_steps);
}

VoxelEstimate estimate_voxels(const tiling::Survey& survey, const SupervoxelScale& scale) {
  VoxelEstimate estimate;
  const std::int64_t side = scale.voxel_steps;
  estimate.voxels = likely_voxels(survey, scale);
  estimate.blocks = std::min(estimate.voxels, count_of_large_cubes(survey, tiling::VoxelIndex::kBlockSide * side));
  const double parts = std::clamp(count_of_large_cubes(survey, tiling::VoxelIndex::kBlockSide * side / 2),
                                  estimate.blocks, estimate.voxels);
  estimate.index_bytes = 40.0 * estimate.blocks + 8.0 * parts;
  estimate.clusters = likely_clusters(estimate.voxels - estimate.blocks, scale);
  return estimate;
}

SupervoxelBytes likely_supervoxel_bytes(const tiling::Survey& survey, const SupervoxelScale& scale,
                                        const SupervoxelParameters& parameters, bool colours, const VoxelMemory& memory,
                                        std::uint64_t resident_bytes) {
  const VoxelEstimate estimate = estimate_voxels(survey, scale);
  const double table =
      std::min(table_entry_bytes(colours) * estimate.voxels, static_cast<double>(memory.table_bytes()));
  const auto index_bytes = static_cast<std::uint64_t>(estimate.index_bytes);
  const auto room = static_cast<double>(memory.stage_bytes(resident_bytes + index_bytes));
  const double each = bytes_per_voxel(estimate, parameters, colours);
  double kept = kept_bytes(estimate, parameters);
  tiling::VoxelPlanRequest plan;
  plan.max_voxels = most_tile_voxels(room - kept, each);
  plan.halo_voxels = scale.halo_voxels();
  double peak = kept + each * largest_tile(survey, scale, plan, estimate.voxels) + kLoneBytes * estimate.lone();
  // Voxels that no seed reaches are clustered again on larger ones, as often as there are larger ones.
  for (SupervoxelScale finer = scale; can_coarsen(finer); finer = coarser(finer, parameters)) {
    const SupervoxelScale level = coarser(finer, parameters);
    const VoxelEstimate all = estimate_voxels(survey, level);
    const double voxels = count_of_leftovers(survey, finer, level);
    kept += (2 * sizeof(std::uint32_t) + all.index_bytes / std::max(1.0, all.voxels)) * voxels;
    const double clusters = likely_clusters(voxels * (1.0 - all.blocks / std::max(1.0, all.voxels)), level);
    const double lone = voxels * all.lone() / std::max(1.0, all.voxels);
    const double here =
        cluster_bytes(parameters) * clusters + bytes_per_voxel(all, parameters, colours) * voxels + kLoneBytes * lone;
    peak = std::max(peak, std::min(room, kept + here));
  }
  const double growing =
      estimate.index_bytes + std::max(static_cast<double>(kVoxelPassBytes), VoxelMemory::kLikelyShare * peak);
  return {static_cast<std::uint64_t>(table + estimate.index_bytes), static_cast<std::uint64_t>(growing)};
}

std::uint64_t predicted_supervoxel_bytes(const tiling::Survey& survey, const SupervoxelScale& scale,
                                         const SupervoxelParameters& parameters, bool colours,
                                         const VoxelMemory& memory) {
  const std::uint64_t while_counting = resident_bytes();
  release_free_memory();
  const std::uint64_t while_growing = resident_bytes();
  const SupervoxelBytes bytes = likely_supervoxel_bytes(survey, scale, parameters, colours, memory, while_growing);
  return std::max(while_counting + bytes.counting, while_growing + bytes.growing);
}

std::uint64_t predicted_scene_bytes(const VoxelEstimate& estimate) {
  return static_cast<std::uint64_t>(estimate.index_bytes + sizeof(std::uint32_t) * estimate.voxels +
                                    kSupervoxelBytes * (estimate.clusters + estimate.lone()));
}

std::uint64_t predicted_store_bytes(const tiling::Survey& survey, const SupervoxelScale& scale, bool colours) {
  const auto each = static_cast<double>(tiling::VoxelLayout(VoxelGrid(scale.voxel_steps), colours).bytes());
  constexpr double kMargin = 1.05;  // Rather too much than too little: noise fills more than surfaces do.
  return static_cast<std::uint64_t>(kMargin * each * likely_voxels(survey, scale));
}

std::uint64_t predicted_voxel_temp_bytes(const tiling::Survey& survey, const SupervoxelScale& scale,
                                         const SupervoxelParameters& parameters, bool colours,
                                         const VoxelMemory& memory) {
  const VoxelEstimate estimate = estimate_voxels(survey, scale);
  const double voxels = estimate.voxels;
  const double table_entries = static_cast<double>(memory.table_bytes()) / table_entry_bytes(colours);
  const double runs = voxels > table_entries ? run_entries(survey, scale, voxels, table_entries) : 0.0;
  const auto room =
      static_cast<double>(memory.stage_bytes(resident_bytes() + static_cast<std::uint64_t>(estimate.index_bytes)));
  const bool tiles = voxels > static_cast<double>(most_tile_voxels(room - kept_bytes(estimate, parameters),
                                                                   bytes_per_voxel(estimate, parameters, colours)));
  // Runs are gone when normals of tiles come.
  const double beside = std::max(runs * run_entry_bytes(colours), tiles ? kNormalBytes * voxels : 0.0);
  return predicted_store_bytes(survey, scale, colours) + static_cast<std::uint64_t>(beside);
}

}  // namespace arris::pipeline
