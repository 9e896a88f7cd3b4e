#include "pipeline/voxel_memory.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/process_memory.h"
#include "core/text.h"

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
constexpr double kVoxelTempBytes = 36.0 + 80.0;
/// Surfaces cut voxels off-centre: about this many per area of a voxel's face.
constexpr double kVoxelsPerFace = 1.5;

/// On top of the least budget that is named: what is resident differs from run to run.
constexpr std::uint64_t kSpareBytes = 4 * kMiB;
/// Per voxel: index and id.
constexpr double kIndexBytes = 3.0 + 4.0;
/// Per supervoxel: moments, table, neighbours.
constexpr double kSupervoxelBytes = 260.0;

double likely_voxels(const tiling::Survey& survey, const SupervoxelScale& scale) {
  const double side = scale.voxel_steps * survey.lattice.step;
  const double per_point = std::min(1.0, kVoxelsPerFace * survey.spacing * survey.spacing / (side * side));
  return static_cast<double>(survey.points()) * per_point;
}

}  // namespace

VoxelMemory::VoxelMemory(std::uint64_t budget_bytes)
    : usable_bytes_(static_cast<std::uint64_t>(kSafety * static_cast<double>(budget_bytes))) {
  const std::uint64_t fixed = resident_bytes() + kPassBytes + kSurveyBytes;
  if (usable_bytes_ < fixed + kLeastTableBytes) {
    throw BudgetError(
        fmt::format("--memory {} is too small: this run needs at least {}", human_bytes(budget_bytes),
                    human_bytes(static_cast<std::uint64_t>(static_cast<double>(fixed + kLeastTableBytes) / kSafety) +
                                kSpareBytes)));
  }
  table_bytes_ = std::clamp((usable_bytes_ - fixed) / 2, kLeastTableBytes, kMostTableBytes);
  index_bytes_ = usable_bytes_ - fixed - table_bytes_;
}

std::uint64_t VoxelMemory::stage_bytes() const {
  before_stage_bytes_ = resident_bytes();
  const std::uint64_t taken = before_stage_bytes_ + kPassBytes / 2;
  return usable_bytes_ > taken ? usable_bytes_ - taken : 0;
}

std::uint64_t VoxelMemory::predicted_peak_bytes(std::uint64_t stage_bytes) const {
  return before_stage_bytes_ + std::max(kPassBytes, stage_bytes);
}

std::uint64_t predicted_scene_bytes(const tiling::Survey& survey, const SupervoxelScale& scale) {
  const double cells = static_cast<double>(scale.seed_steps) / scale.voxel_steps;
  const double each = kIndexBytes + kVoxelsPerFace * kSupervoxelBytes / (cells * cells);
  return static_cast<std::uint64_t>(likely_voxels(survey, scale) * each);
}

std::uint64_t predicted_voxel_temp_bytes(const tiling::Survey& survey, const SupervoxelScale& scale) {
  return static_cast<std::uint64_t>(likely_voxels(survey, scale) * kVoxelTempBytes) + kMiB;
}

}  // namespace arris::pipeline
