#include "pipeline/voxel_estimate.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "core/process_memory.h"
#include "survey_of.h"

namespace arris::pipeline {
namespace {

using test::survey_of;

constexpr std::uint64_t kGiB = std::uint64_t{1} << 30;

/// A slanted square of 20 m with points every 2 cm.
std::vector<LatticePoint> plane() {
  std::vector<LatticePoint> points;
  for (std::int32_t x = 0; x < 20'000; x += 20) {
    for (std::int32_t y = 0; y < 20'000; y += 20) points.push_back({x, y, x / 3 + y / 5});
  }
  return points;
}

std::vector<LatticePoint> far_apart() {
  std::mt19937 random(7);
  const auto any = [&] { return static_cast<std::int32_t>(random() % 2'000'000'000) - 1'000'000'000; };
  std::vector<LatticePoint> points;
  for (int i = 0; i < 100'000; ++i) points.push_back({any(), any(), any()});
  return points;
}

SupervoxelScale scale_of(std::int32_t voxel_steps) {
  return make_scale(voxel_steps, 8 * std::int64_t{voxel_steps}, {});
}

TEST(VoxelEstimate, Plane_IsWithinAQuarterOfItsVoxelsAndHasNoLoneOnes) {
  const VoxelEstimate estimate = estimate_voxels(survey_of(plane()), scale_of(50));
  // A slanted square of this slope crosses about (1 + 1/3 + 1/5) voxels per voxel's face.
  const double expected = 400.0 * 400.0 * (1.0 + 1.0 / 3.0 + 1.0 / 5.0);
  EXPECT_NEAR(estimate.voxels / expected, 1.0, 0.25);
  EXPECT_LT(estimate.blocks, estimate.voxels / 20.0);
  EXPECT_EQ(estimate.lone(), 0.0);
  EXPECT_LT(estimate.index_bytes, 5.0 * estimate.voxels);
}

TEST(VoxelEstimate, PointsFarApart_AreLoneVoxelsWithABlockEach) {
  const VoxelEstimate estimate = estimate_voxels(survey_of(far_apart()), scale_of(50));
  EXPECT_NEAR(estimate.voxels, 100'000.0, 1'000.0);
  EXPECT_NEAR(estimate.lone(), 100'000.0, 2'000.0);
  EXPECT_NEAR(estimate.index_bytes, 48.0 * 100'000.0, 100'000.0);
}

// A voxel for each point: no run holds one that another has, however small the table is.
TEST(VoxelEstimate, VoxelsOfOnePoint_AreInOneRunOnly) {
  const tiling::Survey survey = survey_of(plane());
  const SupervoxelScale scale = scale_of(2);
  const double voxels = estimate_voxels(survey, scale).voxels;
  const VoxelMemory memory((resident_bytes() + kGiB / 25) * 100 / 92);
  const auto store = static_cast<double>(predicted_store_bytes(survey, scale, false));
  const double runs = static_cast<double>(predicted_voxel_temp_bytes(survey, scale, {}, false, memory)) - store;
  EXPECT_NEAR(runs / (28.0 * voxels), 1.0, 0.05);
}

TEST(VoxelEstimate, SmallerBudget_ForetellsNoMoreThanTheBudget) {
  const tiling::Survey survey = survey_of(plane());
  const SupervoxelScale scale = scale_of(20);
  const double voxels = estimate_voxels(survey, scale).voxels;
  const std::uint64_t much = predicted_supervoxel_bytes(survey, scale, {}, false, VoxelMemory(4 * kGiB));
  const std::uint64_t budget = resident_bytes() + kGiB / 4;  // Sanitizers take much themselves.
  const std::uint64_t little = predicted_supervoxel_bytes(survey, scale, {}, false, VoxelMemory(budget));
  EXPECT_GT(static_cast<double>(much), 95.0 * voxels) << "all are in one tile";
  EXPECT_LE(little, budget);
}

TEST(VoxelEstimate, Colours_TakeMoreMemoryAndDisk) {
  const tiling::Survey survey = survey_of(plane());
  const SupervoxelScale scale = scale_of(20);
  const double voxels = estimate_voxels(survey, scale).voxels;
  const auto more = [](std::uint64_t with, std::uint64_t without) { return static_cast<double>(with - without); };
  const double of_store = more(predicted_store_bytes(survey, scale, true), predicted_store_bytes(survey, scale, false));
  EXPECT_NEAR(of_store, 1.05 * 6.0 * voxels, 2.0) << "a twentieth more than likely";
  const VoxelMemory much(4 * kGiB);
  const SupervoxelBytes without = likely_supervoxel_bytes(survey, scale, {}, false, much, kGiB / 16);
  const SupervoxelBytes with = likely_supervoxel_bytes(survey, scale, {}, true, much, kGiB / 16);
  EXPECT_GT(more(with.growing, without.growing), 11.0 * voxels);
  EXPECT_GT(more(with.counting, without.counting), 11.0 * voxels);
  const VoxelMemory little((resident_bytes() + kGiB / 25) * 100 / 92);
  EXPECT_GT(more(predicted_voxel_temp_bytes(survey, scale, {}, true, little),
                 predicted_voxel_temp_bytes(survey, scale, {}, false, little)),
            (6.0 + 11.0) * voxels)
      << "store and runs";
}

}  // namespace
}  // namespace arris::pipeline
