#include "pipeline/voxel_memory.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/pages.h"
#include "core/process_memory.h"
#include "core/text.h"

namespace arris::pipeline {
namespace {

constexpr std::uint64_t kMiB = 1024 * 1024;
constexpr double kSafety = 0.92;
/// Fragments of the allocator while points become voxels.
constexpr std::uint64_t kSurveyBytes = 8 * kMiB;
constexpr std::uint64_t kLeastTableBytes = 4 * kMiB;
constexpr std::uint64_t kMostTableBytes = 96 * kMiB;
/// On top of the least budget that is named: what is resident differs from run to run, by up to 9 MiB where the system
/// maps more of the program's libraries at a fault.
constexpr std::uint64_t kSpareBytes = 12 * kMiB;
/// Pages that the steps of a tile leave unused at its peak. Measured.
constexpr std::uint64_t kUnusedBytes = 13 * kMiB / 2;

}  // namespace

VoxelMemory::VoxelMemory(std::uint64_t budget_bytes)
    : usable_bytes_(static_cast<std::uint64_t>(kSafety * static_cast<double>(budget_bytes))) {
  release_free_memory();  // What reading has left differs from run to run.
  const std::uint64_t fixed = resident_bytes() + kVoxelPassBytes + kSurveyBytes;
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
  return stage_bytes(before_stage_bytes_);
}

std::uint64_t VoxelMemory::stage_bytes(std::uint64_t resident_bytes) const {
  const std::uint64_t taken = resident_bytes + kVoxelPassBytes / 2;
  return usable_bytes_ > taken ? usable_bytes_ - taken : 0;
}

std::uint64_t VoxelMemory::predicted_peak_bytes(std::uint64_t stage_bytes) const {
  return std::max(
      peak_before_stage_bytes_,
      before_stage_bytes_ + kUnusedBytes +
          std::max(kVoxelPassBytes, static_cast<std::uint64_t>(kLikelyShare * static_cast<double>(stage_bytes))));
}

std::uint64_t more_than_fits(std::uint64_t budget_bytes, std::uint64_t bytes) {
  const auto usable = static_cast<std::uint64_t>(kSafety * static_cast<double>(budget_bytes));
  const std::uint64_t needed = resident_bytes() + bytes;
  return needed > usable ? needed - usable : 0;
}

std::uint64_t raised_budget_bytes(std::uint64_t budget_bytes, std::uint64_t more_bytes) {
  return budget_bytes + static_cast<std::uint64_t>(static_cast<double>(more_bytes) / kSafety) + kSpareBytes;
}

}  // namespace arris::pipeline
