#pragma once
/// @file How the memory budget is divided when points become voxels and voxels supervoxels.

#include <cstdint>

namespace arris::pipeline {

/// Batches with their records, read and write buffers; measured, rounded up.
constexpr std::uint64_t kVoxelPassBytes = 16 * 1024 * 1024;

/// The voxel table is freed before supervoxels grow, so each gets what the other leaves.
class VoxelMemory {
 public:
  /// Of what the clustering may take at its peak, so much is likely. Measured.
  static constexpr double kLikelyShare = 0.93;

  /// Throws BudgetError if not even the least voxel table fits.
  explicit VoxelMemory(std::uint64_t budget_bytes);
  /// Of the table that sums points per voxel.
  std::uint64_t table_bytes() const { return table_bytes_; }
  /// Most that the index of all voxels may take.
  std::uint64_t index_bytes() const { return index_bytes_; }
  /// For the clustering, as things stand now: what is resident is deducted.
  std::uint64_t stage_bytes() const;
  /// The same if so much will be resident.
  std::uint64_t stage_bytes(std::uint64_t resident_bytes) const;
  /// What was resident so far is known by then.
  std::uint64_t predicted_peak_bytes(std::uint64_t stage_bytes) const;

 private:
  std::uint64_t usable_bytes_;
  std::uint64_t table_bytes_;
  std::uint64_t index_bytes_;
  mutable std::uint64_t before_stage_bytes_ = 0;
  mutable std::uint64_t peak_before_stage_bytes_ = 0;
};

/// How much is missing for so many bytes beside what is resident now; 0 if they fit.
std::uint64_t more_than_fits(std::uint64_t budget_bytes, std::uint64_t bytes);
/// The budget that leaves so much more than this one.
std::uint64_t raised_budget_bytes(std::uint64_t budget_bytes, std::uint64_t more_bytes);

}  // namespace arris::pipeline
