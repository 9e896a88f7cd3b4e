#pragma once
/// @file Sorts sums of voxels.

#include <cstddef>
#include <cstdint>
#include <span>

#include "tiling/page_array.h"
#include "tiling/voxel_sums.h"

namespace arris::tiling {

/// Memory taken while sorting, per element.
constexpr std::size_t kOrderBytes = 2 * (sizeof(std::uint64_t) + sizeof(std::uint32_t));

/// Indices of the sums (fewer than 2^32) in Z-order of their keys, equal keys side by side. Radix sort by all threads,
/// O(n); O(n log n) where the keys are too far apart for z_order_key.h.
PageArray<std::uint32_t> z_order_of(std::span<const VoxelSums> sums);

}  // namespace arris::tiling
