#include "pipeline/voxel_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/pages.h"
#include "core/process_memory.h"
#include "core/text.h"
#include "core/voxel.h"
#include "features/supervoxel/voxel_features.h"
#include "tiling/voxel_file.h"
#include "tiling/voxel_order.h"
#include "tiling/voxel_sums.h"

namespace arris::pipeline {
namespace {

constexpr std::uint64_t kMiB = 1024 * 1024;
constexpr double kSafety = 0.92;
/// Batches with their records, read and write buffers; measured, rounded up.
constexpr std::uint64_t kPassBytes = 16 * kMiB;
/// Fragments of the allocator while points become voxels.
constexpr std::uint64_t kSurveyBytes = 8 * kMiB;
constexpr std::uint64_t kLeastTableBytes = 4 * kMiB;
constexpr std::uint64_t kMostTableBytes = 96 * kMiB;
/// Of runs, where there are any: neighbours in the file are neighbours in space, but a street is scanned twice.
constexpr double kRunEntries = 1.35;
constexpr double kTableEntryBytes = sizeof(tiling::VoxelSums) + tiling::kOrderBytes;
/// Surfaces cut voxels off-centre: about this many per area of a voxel's face.
constexpr double kVoxelsPerFace = 1.5;
/// Neighbours of a voxel of a surface.
constexpr double kNeighbours = 12.0;
constexpr double kNormalBytes = 12.0;

/// On top of the least budget that is named: what is resident differs from run to run.
constexpr std::uint64_t kSpareBytes = 4 * kMiB;
/// Per voxel: index and id.
constexpr double kIndexBytes = 3.0 + 4.0;
/// Per supervoxel: moments, table, neighbours.
constexpr double kSupervoxelBytes = 260.0;

/// From the counts of the survey: the points of a cell fill what voxels a surface through it crosses. Within a tenth on
/// towns of any density, 0.8 of what there is where voxels are as large as the survey's cells.
double count_of_voxels(const tiling::Survey& survey, const SupervoxelScale& scale) {
  constexpr double kTilted = 1.3;  // More than a flat surface crosses. Measured.
  const double sides = std::ldexp(1.0, survey.counts.level()) / scale.voxel_steps;  // Voxels along a cell.
  const double flat = 0.5 * (1.0 + sides * sides);  // A cell is seldom crossed from side to side.
  double voxels = 0.0;
  survey.counts.for_each([&](const LatticeBox&, std::uint64_t points) {
    const auto n = static_cast<double>(points);
    voxels += std::min(n, kTilted * flat * (1.0 - std::exp(-n / flat)));
  });
  return voxels;
}

}  // namespace

VoxelMemory::VoxelMemory(std::uint64_t budget_bytes)
    : usable_bytes_(static_cast<std::uint64_t>(kSafety * static_cast<double>(budget_bytes))) {
  const std::uint64_t fixed = resident_bytes() + kPassBytes + kSurveyBytes;
  if (usable_bytes_ < fixed + kLeastTableBytes) {
    throw BudgetError(
        fmt::format("--memory {} is too small: this run needs at least {}", human_bytes(budget_bytes),
                    budget_text(static_cast<std::uint64_t>(static_cast<double>(fixed + kLeastTableBytes) / kSafety) +
                                kSpareBytes)));
  }
  table_bytes_ = std::clamp((usable_bytes_ - fixed) / 2, kLeastTableBytes, kMostTableBytes);
  index_bytes_ = usable_bytes_ - fixed - table_bytes_;
}

std::uint64_t VoxelMemory::stage_bytes() const {
  before_stage_bytes_ = resident_bytes() - spare_pages_bytes();  // The stage takes those first.
  peak_before_stage_bytes_ = peak_resident_bytes();
  const std::uint64_t taken = before_stage_bytes_ + kPassBytes / 2;
  return usable_bytes_ > taken ? usable_bytes_ - taken : 0;
}

std::uint64_t VoxelMemory::predicted_peak_bytes(std::uint64_t stage_bytes) const {
  return std::max(peak_before_stage_bytes_, before_stage_bytes_ + std::max(kPassBytes, stage_bytes));
}

std::uint64_t likely_voxels(const tiling::Survey& survey, const SupervoxelScale& scale) {
  return static_cast<std::uint64_t>(count_of_voxels(survey, scale));
}

std::uint64_t predicted_supervoxel_bytes(const tiling::Survey& survey, const SupervoxelScale& scale,
                                         const SupervoxelParameters& parameters, std::uint64_t budget_bytes) {
  constexpr double kOfVoxels = 0.85;  // The steps that take most are not all at their peak together. Measured.
  constexpr double kOfBudget = 0.78;  // What is in tiles is not all there at once: 0.56 to 0.91, as they can be cut.
  const double voxels = count_of_voxels(survey, scale);
  const double each = supervoxel_bytes_per_voxel(parameters.features, false, kNeighbours);
  const double all =
      static_cast<double>(resident_bytes() + predicted_scene_bytes(survey, scale)) + kOfVoxels * each * voxels;
  return static_cast<std::uint64_t>(std::min(all, kOfBudget * static_cast<double>(budget_bytes)));
}

std::uint64_t more_than_fits(std::uint64_t budget_bytes, std::uint64_t bytes) {
  const auto usable = static_cast<std::uint64_t>(kSafety * static_cast<double>(budget_bytes));
  const std::uint64_t needed = resident_bytes() + bytes;
  return needed > usable ? needed - usable : 0;
}

std::uint64_t raised_budget_bytes(std::uint64_t budget_bytes, std::uint64_t more_bytes) {
  return budget_bytes + static_cast<std::uint64_t>(static_cast<double>(more_bytes) / kSafety) + kSpareBytes;
}

std::uint64_t predicted_scene_bytes(const tiling::Survey& survey, const SupervoxelScale& scale) {
  const double cells = static_cast<double>(scale.seed_steps) / scale.voxel_steps;
  const double each = kIndexBytes + kVoxelsPerFace * kSupervoxelBytes / (cells * cells);
  return static_cast<std::uint64_t>(count_of_voxels(survey, scale) * each);
}

std::uint64_t predicted_voxel_temp_bytes(const tiling::Survey& survey, const SupervoxelScale& scale,
                                         const VoxelMemory& memory) {
  const double voxels = count_of_voxels(survey, scale);
  const auto room = static_cast<double>(memory.table_bytes() + memory.index_bytes());
  const bool runs = voxels * kTableEntryBytes > static_cast<double>(memory.table_bytes());
  const bool tiles =
      voxels * supervoxel_bytes_per_voxel(SupervoxelParameters::Features::kNormal, false, kNeighbours) > room;
  const auto store_bytes = static_cast<double>(tiling::VoxelLayout(VoxelGrid(scale.voxel_steps), false).bytes());
  // Runs are gone when normals of tiles come.
  const double beside = std::max(runs ? kRunEntries * sizeof(tiling::VoxelSums) : 0.0, tiles ? kNormalBytes : 0.0);
  return static_cast<std::uint64_t>(voxels * (store_bytes + beside));
}

}  // namespace arris::pipeline
