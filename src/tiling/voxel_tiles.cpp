#include "tiling/voxel_tiles.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

#include "core/parallel.h"

namespace arris::tiling {
namespace {

constexpr std::size_t kGrain = 16 * 1024;
constexpr int kBlockLevel = 3;  // Of VoxelIndex.
constexpr int kAround = 27;
constexpr int kSelf = 13;

/// The voxel at offset `i` of the 27, in ascending (dx, dy, dz); false beyond int32.
bool neighbour_key(const LatticePoint& key, int i, LatticePoint& neighbour) {
  const std::int64_t x = std::int64_t{key.x} + i / 9 - 1;
  const std::int64_t y = std::int64_t{key.y} + i / 3 % 3 - 1;
  const std::int64_t z = std::int64_t{key.z} + i % 3 - 1;
  const auto fits = [](std::int64_t v) {
    return v >= std::numeric_limits<std::int32_t>::min() && v <= std::numeric_limits<std::int32_t>::max();
  };
  if (!fits(x) || !fits(y) || !fits(z)) return false;
  neighbour = {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), static_cast<std::int32_t>(z)};
  return true;
}

std::uint32_t existing_neighbours(const VoxelIndex& index, const LatticePoint& key, std::uint32_t& hint) {
  std::uint32_t mask = 0;
  for (int i = 0; i < kAround; ++i) {
    LatticePoint at;
    if (i != kSelf && neighbour_key(key, i, at) && index.rank(at, hint) != VoxelIndex::kNone) mask |= 1U << i;
  }
  return mask;
}

/// @param index  of exactly the tile's voxels.
void link_neighbours(VoxelTile& tile, const VoxelIndex& index) {
  std::vector<std::uint32_t> masks(tile.size());
  parallel_for_chunks(tile.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::uint32_t hint = 0;
    for (std::size_t v = begin; v < end; ++v) masks[v] = existing_neighbours(index, tile.keys[v], hint);
  });
  tile.neighbour_begin.resize(tile.size() + 1);
  tile.neighbour_begin[0] = 0;
  for (std::size_t v = 0; v < tile.size(); ++v)
    tile.neighbour_begin[v + 1] = tile.neighbour_begin[v] + static_cast<std::uint32_t>(std::popcount(masks[v]));
  tile.neighbours.resize(tile.neighbour_begin.back());
  parallel_for_chunks(tile.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::uint32_t hint = 0;
    for (std::size_t v = begin; v < end; ++v) {
      std::uint32_t* to = &tile.neighbours[tile.neighbour_begin[v]];
      for (std::uint32_t mask = masks[v]; mask != 0; mask &= mask - 1) {
        LatticePoint at;
        neighbour_key(tile.keys[v], std::countr_zero(mask), at);
        *to++ = index.rank(at, hint);
      }
    }
  });
}

}  // namespace

TilePlan plan_voxel_tiles(const VoxelIndex& index, const VoxelPlanRequest& request) {
  Survey voxels;  // Voxels take the place of points, one to a step.
  voxels.lattice = {1.0, {0.0, 0.0, 0.0}};
  voxels.bounds = index.bounds();
  voxels.points_in = index.size();
  voxels.spacing = 1.0;
  voxels.counts = CellCounts(kBlockLevel);
  for (std::size_t i = 0; i < index.blocks(); ++i) {
    const VoxelIndex::Block block = index.block(i);
    const LatticePoint corner{block.key.x * (1 << kBlockLevel), block.key.y * (1 << kBlockLevel),
                              block.key.z * (1 << kBlockLevel)};
    voxels.counts.add(corner, block.voxels);
  }
  PlanRequest plan;
  plan.max_points = request.max_voxels;
  plan.max_core_points = request.max_core_voxels;
  plan.max_radius = std::max(1, request.halo_voxels);
  plan.whole_halo = true;
  plan.halo = [&](double) { return static_cast<double>(request.halo_voxels); };
  return plan_tiles(voxels, plan);
}

VoxelTile load_voxel_tile(const VoxelStore& store, const PlannedTile& planned, bool colours) {
  VoxelTile tile(store.grid());
  std::vector<Voxel> voxels;
  store.load(planned.covered, voxels, tile.ranks);
  const std::size_t count = voxels.size();
  tile.keys.resize(count);
  tile.positions.resize(count);
  tile.core.resize(count);
  if (colours) tile.colours.resize(count);
  parallel_for_chunks(count, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const LatticePoint& key = voxels[v].key;
      tile.keys[v] = key;
      for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t corner = kVoxelFractions * store.grid().corner(key[axis]);
        tile.positions[v][static_cast<std::size_t>(axis)] =
            static_cast<std::uint32_t>(static_cast<std::uint64_t>(corner)) +
            voxels[v].centroid[static_cast<std::size_t>(axis)];
      }
      tile.core[v] = planned.core.contains(key) ? 1 : 0;
      if (colours) tile.colours[v] = voxels[v].colour;
    }
  });
  voxels = {};
  if (count == store.size()) {
    link_neighbours(tile, store.index());
  } else {
    VoxelIndex index;
    for (const LatticePoint& key : tile.keys) index.append(key);
    index.finish();
    link_neighbours(tile, index);
  }
  return tile;
}

}  // namespace arris::tiling
