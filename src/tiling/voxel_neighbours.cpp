#include "tiling/voxel_neighbours.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "core/parallel.h"

namespace arris::tiling {
namespace {

constexpr std::size_t kGrain = 128;  // Blocks.
constexpr int kSide = VoxelIndex::kBlockSide;
constexpr int kCube = kSide + 2;
constexpr int kAround = 27;
constexpr int kSelf = 13;
constexpr std::uint32_t kParts = VoxelIndex::kBlockParts;
constexpr std::uint32_t kPartPlaces = 64;

/// From a cell of the cube to the cells around it, in ascending (dx, dy, dz).
constexpr std::array<int, kAround> cell_offsets() {
  std::array<int, kAround> offsets{};
  for (int i = 0; i < kAround; ++i) offsets[i] = ((i / 9 - 1) * kCube + i / 3 % 3 - 1) * kCube + i % 3 - 1;
  return offsets;
}
constexpr std::array<int, kAround> kOffsets = cell_offsets();

/// Cells of the places in a block, counted from the block's first.
constexpr std::array<std::uint16_t, kParts * kPartPlaces> cells_of_places() {
  std::array<std::uint16_t, kParts * kPartPlaces> cells{};
  for (int x = 0; x < kSide; ++x) {
    for (int y = 0; y < kSide; ++y) {
      for (int z = 0; z < kSide; ++z)
        cells[VoxelIndex::place_in_block({x, y, z})] = static_cast<std::uint16_t>((x * kCube + y) * kCube + z);
    }
  }
  return cells;
}
constexpr auto kCells = cells_of_places();

/// For a block that lies at (dx, dy, dz) from another one: its places that touch the other, a word per part.
constexpr std::array<std::array<std::uint64_t, kParts>, kAround> touching_places() {
  std::array<std::array<std::uint64_t, kParts>, kAround> touching{};
  const auto touches = [](int d, int at) { return d == 0 || at == (d < 0 ? kSide - 1 : 0); };
  for (int i = 0; i < kAround; ++i) {
    for (int x = 0; x < kSide; ++x) {
      for (int y = 0; y < kSide; ++y) {
        for (int z = 0; z < kSide; ++z) {
          if (!touches(i / 9 - 1, x) || !touches(i / 3 % 3 - 1, y) || !touches(i % 3 - 1, z)) continue;
          const std::uint32_t place = VoxelIndex::place_in_block({x, y, z});
          touching[i][place / kPartPlaces] |= std::uint64_t{1} << (place % kPartPlaces);
        }
      }
    }
  }
  return touching;
}
constexpr auto kTouching = touching_places();

/// Calls use(bit number) for the bits that are set, lowest first.
template <class Word, class Use>
void for_each_bit(Word word, Use&& use) {
  for (; word != 0; word &= word - 1) use(static_cast<std::uint32_t>(std::countr_zero(word)));
}

/// A block with one layer of voxels around it. Which cells hold voxels is known by bits, so that nothing is asked of
/// those that do not; ranks are there only where a bit says so, and only if they are asked for.
template <bool kRanks>
class Cube {
 public:
  explicit Cube(const VoxelIndex& index) : index_(index) {}

  void load(std::size_t block) {
    rows_.fill(0);
    const LatticePoint key = index_.block(block).key;
    for (int i = 0; i < kAround; ++i) {
      // Keys of blocks have 29 bits, so their neighbours' fit.
      const std::uint32_t at = i == kSelf ? static_cast<std::uint32_t>(block)
                                          : find({key.x + i / 9 - 1, key.y + i / 3 % 3 - 1, key.z + i % 3 - 1});
      if (at != VoxelIndex::kNone) add(at, i);
    }
  }

  /// Calls use(bits of the neighbours by kOffsets, cell) for the voxels of the block in ascending ranks.
  template <class Use>
  void for_each_voxel(std::size_t block, Use&& use) const {
    for (std::uint32_t part = 0; part < kParts; ++part) {
      for_each_bit(index_.part(block, part).bits, [&](std::uint32_t bit) {
        const int cell = kFirst + kCells[part * kPartPlaces + bit];
        use(around(cell), cell);
      });
    }
  }
  std::uint32_t rank(int cell) const { return ranks_[static_cast<std::size_t>(cell)]; }

 private:
  static constexpr int kFirst = (kCube + 1) * kCube + 1;  // Cell of the block's first place.

  void add(std::uint32_t block, int direction) {
    const int first = kFirst + kSide * kOffsets[direction];
    for (std::uint32_t part = 0; part < kParts; ++part) {
      const std::uint64_t touching = kTouching[direction][part];
      if (touching == 0) continue;
      const VoxelIndex::Part voxels = index_.part(block, part);
      for_each_bit(voxels.bits & touching, [&](std::uint32_t bit) {
        const int cell = first + kCells[part * kPartPlaces + bit];
        rows_[static_cast<std::size_t>(cell / kCube)] |= static_cast<std::uint16_t>(1U << cell % kCube);
        if constexpr (kRanks) ranks_[static_cast<std::size_t>(cell)] = voxels.rank(bit);
      });
    }
  }

  std::uint32_t around(int cell) const {
    const int row = cell / kCube;
    const int below = cell % kCube - 1;
    std::uint32_t bits = 0;
    for (int i = 0; i < 9; ++i) {
      const auto at = static_cast<std::size_t>(row + (i / 3 - 1) * kCube + i % 3 - 1);
      bits |= (std::uint32_t{rows_[at]} >> below & 7U) << 3 * i;
    }
    return bits & ~(1U << kSelf);
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

  const VoxelIndex& index_;
  std::vector<Found> recent_ = std::vector<Found>(2048);
  std::array<std::uint16_t, kCube * kCube> rows_{};           // A bit per cell.
  std::array<std::uint32_t, kCube * kCube * kCube> ranks_{};  // Per cell.
};

/// How many neighbours the voxels of some blocks have, in counts[rank].
void count_neighbours(const VoxelIndex& index, std::size_t begin, std::size_t end, std::uint32_t* counts) {
  Cube<false> cube(index);
  for (std::size_t block = begin; block < end; ++block) {
    cube.load(block);
    std::uint32_t* count = counts + index.block(block).first_rank;
    cube.for_each_voxel(block, [&](std::uint32_t around, int) { *count++ = VoxelIndex::ones(around); });
  }
}

/// Those neighbours, from `list` on.
void list_neighbours(const VoxelIndex& index, std::size_t begin, std::size_t end, std::uint32_t* list) {
  Cube<true> cube(index);
  for (std::size_t block = begin; block < end; ++block) {
    cube.load(block);
    cube.for_each_voxel(block, [&](std::uint32_t around, int cell) {
      for_each_bit(around, [&](std::uint32_t i) { *list++ = cube.rank(cell + kOffsets[i]); });
    });
  }
}

}  // namespace

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
