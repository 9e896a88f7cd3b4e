#include "tiling/voxel_neighbours.h"

#include <algorithm>
#include <array>

#include "core/parallel.h"

namespace arris::tiling {
namespace {

constexpr std::size_t kGrain = 1024;  // Blocks.
constexpr std::int32_t kSide = 8;     // Of a block.
constexpr std::int32_t kCube = kSide + 2;
constexpr std::size_t kNeighbours = 26;

/// From a cell of the cube, in ascending (dx, dy, dz).
constexpr std::array<int, kNeighbours> neighbour_offsets() {
  std::array<int, kNeighbours> offsets{};
  std::size_t i = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) offsets[i++] = (x * kCube + y) * kCube + z;
      }
    }
  }
  return offsets;
}

/// A block with one layer of voxels around it.
class Cube {
 public:
  Cube(const VoxelTile& tile, const VoxelIndex& index) : tile_(tile), index_(index) { cells_.fill(VoxelIndex::kNone); }

  void load(std::size_t block) {
    for (const std::uint32_t cell : used_) cells_[cell] = VoxelIndex::kNone;
    used_.clear();
    const VoxelIndex::Block middle = index_.block(block);
    corner_ = {middle.key.x * kSide, middle.key.y * kSide, middle.key.z * kSide};
    add(middle);
    for (std::int64_t x = -1; x <= 1; ++x) {
      for (std::int64_t y = -1; y <= 1; ++y) {
        for (std::int64_t z = -1; z <= 1; ++z) {
          if (x == 0 && y == 0 && z == 0) continue;
          // Keys of blocks have 29 bits, so their neighbours' fit.
          const LatticePoint key{static_cast<std::int32_t>(middle.key.x + x),
                                 static_cast<std::int32_t>(middle.key.y + y),
                                 static_cast<std::int32_t>(middle.key.z + z)};
          const std::uint32_t found = find(key);
          if (found != VoxelIndex::kNone) add(index_.block(found));
        }
      }
    }
  }

  /// Calls use(neighbour) for the neighbours of a voxel of the block, in ascending (dx, dy, dz).
  template <class Use>
  void for_each_neighbour(std::size_t voxel, Use&& use) const {
    const std::uint32_t* const middle = cells_.data() + cell_of(tile_.keys[voxel]);
    for (const int offset : kOffsets) {
      const std::uint32_t neighbour = middle[offset];
      if (neighbour != VoxelIndex::kNone) use(neighbour);
    }
  }

 private:
  static constexpr std::array<int, kNeighbours> kOffsets = neighbour_offsets();

  std::uint32_t cell_of(const LatticePoint& key) const {
    const std::int32_t x = key.x - corner_.x + 1;  // Differences first: they fit, sums with keys need not.
    const std::int32_t y = key.y - corner_.y + 1;
    const std::int32_t z = key.z - corner_.z + 1;
    return static_cast<std::uint32_t>((x * kCube + y) * kCube + z);
  }

  void add(const VoxelIndex::Block& block) {
    for (std::uint32_t v = block.first_rank; v < block.first_rank + block.voxels; ++v) {
      const LatticePoint& key = tile_.keys[v];
      const auto inside = [](std::int64_t at, std::int64_t corner) { return at >= corner - 1 && at <= corner + kSide; };
      if (!inside(key.x, corner_.x) || !inside(key.y, corner_.y) || !inside(key.z, corner_.z)) continue;
      const std::uint32_t cell = cell_of(key);
      cells_[cell] = v;
      used_.push_back(cell);
    }
  }

  /// Blocks come in Z-order: most of those around one were around the one before.
  std::uint32_t find(const LatticePoint& block) {
    Found& slot = recent_[static_cast<std::size_t>((block.x & 15) | (block.y & 15) << 4 | (block.z & 7) << 8)];
    if (!slot.known || slot.key != block) slot = {block, index_.find_block(block), true};
    return slot.index;
  }

  struct Found {
    LatticePoint key;
    std::uint32_t index = 0;
    bool known = false;
  };

  const VoxelTile& tile_;
  const VoxelIndex& index_;
  std::vector<Found> recent_ = std::vector<Found>(2048);
  LatticePoint corner_;
  std::array<std::uint32_t, kCube * kCube * kCube> cells_;
  std::vector<std::uint32_t> used_;
};

}  // namespace

void link_neighbours(VoxelTile& tile, const VoxelIndex& index) {
  const std::size_t blocks = index.blocks();
  std::vector<std::vector<std::uint32_t>> lists((blocks + kGrain - 1) / kGrain);  // Of a chunk of blocks each.
  tile.neighbour_begin.assign(tile.size() + 1, 0);
  parallel_for_chunks(blocks, kGrain, [&](std::size_t begin, std::size_t end) {
    Cube cube(tile, index);
    std::vector<std::uint32_t>& list = lists[begin / kGrain];
    for (std::size_t i = begin; i < end; ++i) {
      cube.load(i);
      const VoxelIndex::Block block = index.block(i);
      for (std::size_t v = block.first_rank; v < block.first_rank + block.voxels; ++v) {
        const std::size_t before = list.size();
        cube.for_each_neighbour(v, [&](std::uint32_t neighbour) { list.push_back(neighbour); });
        tile.neighbour_begin[v + 1] = static_cast<std::uint32_t>(list.size() - before);
      }
    }
    list.shrink_to_fit();
  });
  for (std::size_t v = 0; v < tile.size(); ++v) tile.neighbour_begin[v + 1] += tile.neighbour_begin[v];
  tile.neighbours.resize(tile.neighbour_begin.back());
  parallel_for_chunks(lists.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t first = tile.neighbour_begin[index.block(i * kGrain).first_rank];
      std::copy(lists[i].begin(), lists[i].end(), tile.neighbours.begin() + first);
      lists[i] = {};
    }
  });
}

}  // namespace arris::tiling
