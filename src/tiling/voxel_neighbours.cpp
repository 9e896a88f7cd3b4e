#include "tiling/voxel_neighbours.h"

#include <algorithm>
#include <array>

#include "core/parallel.h"
#include "tiling/voxel_cube.h"

namespace arris::tiling {
namespace {

constexpr std::size_t kGrain = 256;  // Blocks.

/// Calls use(cell, bits of the neighbours) for the voxels of some blocks in ascending ranks.
template <bool kRanks, class Use>
void for_each_voxel(const VoxelIndex& index, VoxelCube<kRanks>& cube, std::size_t begin, std::size_t end, Use&& use) {
  for (std::size_t block = begin; block < end;) {
    const BlockRange group = block_group(index, block);
    cube.load(group);
    for (const std::size_t last = std::min(group.end, end); block < last; ++block) cube.for_each_voxel(block, use);
  }
}

/// How many neighbours the voxels of some blocks have, in counts[rank].
void count_neighbours(const VoxelIndex& index, std::size_t begin, std::size_t end, std::uint32_t* counts) {
  VoxelCube<false> cube(index);
  std::uint32_t* count = counts + index.block(begin).first_rank;
  for_each_voxel(index, cube, begin, end, [&](int, std::uint32_t around) { *count++ = VoxelIndex::ones(around); });
}

/// Those neighbours, from `list` on.
void list_neighbours(const VoxelIndex& index, std::size_t begin, std::size_t end, std::uint32_t* list) {
  VoxelCube<true> cube(index);
  for_each_voxel(index, cube, begin, end, [&](int cell, std::uint32_t around) {
    cube.for_each_neighbour(cell, around, [&](std::uint32_t rank) { *list++ = rank; });
  });
}

}  // namespace

void for_each_neighbourhood(
    const VoxelIndex& index, std::size_t begin, std::size_t end,
    const std::function<void(std::uint32_t rank, std::span<const std::uint32_t> neighbours)>& use) {
  if (begin == end) return;
  VoxelCube<true> cube(index);
  std::uint32_t rank = index.block(begin).first_rank;
  std::array<std::uint32_t, cube::kAround> neighbours;
  for_each_voxel(index, cube, begin, end, [&](int cell, std::uint32_t around) {
    std::size_t count = 0;
    cube.for_each_neighbour(cell, around, [&](std::uint32_t neighbour) { neighbours[count++] = neighbour; });
    use(rank++, std::span(neighbours).first(count));
  });
}

void link_neighbours(VoxelTile& tile, const VoxelIndex& index) {
  tile.neighbour_begin.resize(tile.size() + 1);
  tile.neighbour_begin[0] = 0;
  parallel_for_chunks(index.blocks(), kGrain, [&](std::size_t begin, std::size_t end) {
    count_neighbours(index, begin, end, tile.neighbour_begin.data() + 1);
  });
  // Known before they are listed: nothing is moved, and no more memory is taken than they fill.
  for (std::size_t v = 0; v < tile.size(); ++v) tile.neighbour_begin[v + 1] += tile.neighbour_begin[v];
  tile.neighbours.resize(tile.neighbour_begin.back());
  parallel_for_chunks(index.blocks(), kGrain, [&](std::size_t begin, std::size_t end) {
    list_neighbours(index, begin, end, tile.neighbours.data() + tile.neighbour_begin[index.block(begin).first_rank]);
  });
}

}  // namespace arris::tiling
