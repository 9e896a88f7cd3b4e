#pragma once
/// @file Leftover voxels as voxels twice as large.

#include <cstdint>
#include <filesystem>
#include <span>

#include "core/cancel.h"
#include "features/supervoxel/supervoxel_parameters.h"
#include "tiling/tile_plan.h"
#include "tiling/voxel_store.h"

namespace arris::pipeline {

/// False at the coarsest voxels: a seed cell would be less than twice as wide as the next ones.
bool can_coarsen(const SupervoxelScale& scale);
/// The scale with voxels twice as large.
SupervoxelScale coarser(const SupervoxelScale& scale, const SupervoxelParameters& parameters);

/// Voxels of twice the side from the centroids of those voxels of `store` that have no cluster, each counted once.
/// @param tiles         cut the store into parts that fit into memory; only their cores are read.
/// @param memory_bytes  for the table and the index of the new voxels. Throws BudgetError if it does not do.
tiling::VoxelStore coarser_voxels(const tiling::VoxelStore& store, const tiling::TilePlan& tiles,
                                  std::span<const std::uint32_t> clusters_of, bool colours,
                                  const std::filesystem::path& folder, std::uint64_t memory_bytes,
                                  const CancelToken& cancel);

/// Gives each voxel without cluster that of the coarser voxel that holds its centroid, plus `first`.
void inherit_clusters(const tiling::VoxelStore& store, const tiling::TilePlan& tiles, const tiling::VoxelStore& coarse,
                      std::span<const std::uint32_t> coarse_clusters, std::uint32_t first,
                      std::span<std::uint32_t> clusters_of, const CancelToken& cancel);

}  // namespace arris::pipeline
