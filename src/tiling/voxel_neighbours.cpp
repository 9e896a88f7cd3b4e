#include "tiling/voxel_neighbours.h"

#include <algorithm>
#include <array>
#include <numeric>

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

/// How many neighbours the voxels of some blocks have together.
std::uint32_t count_neighbours(const VoxelIndex& index, std::size_t begin, std::size_t end) {
  VoxelCube<false> cube(index);
  std::uint32_t count = 0;
  for_each_voxel(index, cube, begin, end, [&](int, std::uint32_t around) { count += VoxelIndex::ones(around); });
  return count;
}

/// Those neighbours, from `first` of the list on, and where those of each voxel end.
void list_neighbours(const VoxelIndex& index, std::size_t begin, std::size_t end, std::uint32_t first,
                     VoxelTile& tile) {
  VoxelCube<true> cube(index);
  std::uint32_t* neighbour = tile.neighbours.data() + first;
  std::uint32_t* ends = tile.neighbour_begin.data() + index.block(begin).first_rank + 1;
  for_each_voxel(index, cube, begin, end, [&](int cell, std::uint32_t around) {
    cube.for_each_neighbour(cell, around, [&](std::uint32_t rank) { *neighbour++ = rank; });
    *ends++ = first += VoxelIndex::ones(around);
  });
}

/// Known before neighbours are listed: nothing is moved then, and no more memory is taken than they fill.
LinkBegins link_begins(const VoxelIndex& index) {
  LinkBegins begins((index.blocks() + kGrain - 1) / kGrain + 1, 0);
  parallel_for_chunks(index.blocks(), kGrain, [&](std::size_t begin, std::size_t end) {
    begins[begin / kGrain + 1] = count_neighbours(index, begin, end);
  });
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  return begins;
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

void link_neighbours(VoxelTile& tile, const VoxelIndex& index, LinkBegins& begins) {
  if (begins.empty()) begins = link_begins(index);
  tile.neighbour_begin.resize(tile.size() + 1);
  tile.neighbour_begin[0] = 0;
  tile.neighbours.resize(begins.back());
  parallel_for_chunks(index.blocks(), kGrain, [&](std::size_t begin, std::size_t end) {
    list_neighbours(index, begin, end, begins[begin / kGrain], tile);
  });
}

}  // namespace arris::tiling
