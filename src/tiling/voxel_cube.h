#pragma once
/// @file Where the voxels around a voxel are found: blocks of an index side by side in a small cube.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tiling/voxel_index.h"

namespace arris::tiling {

namespace cube {

constexpr int kAround = 27;
/// Cells along a side: two blocks and a layer on both sides.
constexpr int kSide = 2 * VoxelIndex::kBlockSide + 2;
constexpr int cell_of(int x, int y, int z) {
  return (x * kSide + y) * kSide + z;
}
/// From a cell to those around it, in ascending (dx, dy, dz).
constexpr std::array<int, kAround> offsets() {
  std::array<int, kAround> cells{};
  for (int i = 0; i < kAround; ++i) cells[i] = cell_of(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1);
  return cells;
}
/// A row of cells along z, and a cell in it.
struct RowCell {
  std::int16_t row;
  std::int16_t z;
  constexpr int cell() const { return row * kSide + z; }
};
constexpr RowCell row_cell(int x, int y, int z) {
  return {static_cast<std::int16_t>(x * kSide + y), static_cast<std::int16_t>(z)};
}
/// Of the places in a block, from the block's first.
constexpr std::array<RowCell, VoxelIndex::kBlockParts * 64> cells_of_places() {
  std::array<RowCell, VoxelIndex::kBlockParts * 64> cells{};
  for (int x = 0; x < VoxelIndex::kBlockSide; ++x) {
    for (int y = 0; y < VoxelIndex::kBlockSide; ++y) {
      for (int z = 0; z < VoxelIndex::kBlockSide; ++z) cells[VoxelIndex::place_in_block({x, y, z})] = row_cell(x, y, z);
    }
  }
  return cells;
}

}  // namespace cube

/// The blocks whose keys differ from that of one in the last bit of each axis only: at most 2x2x2, side by side in
/// Z-order.
BlockRange block_group(const VoxelIndex& index, std::size_t block);

/// The voxels of a group of blocks with one layer of voxels around them, where neighbours lie at fixed offsets. Which
/// cells hold voxels is known by bits, so that nothing is asked of those that do not. One per thread: it is used again.
///
/// kRanks: remembers ranks; else only bits are known.
template <bool kRanks>
class VoxelCube {
 public:
  explicit VoxelCube(const VoxelIndex& index) : index_(index) {}

  void load(const BlockRange& group);

  /// Calls use(cell, bits of the neighbours) for the voxels of a block of the group in ascending ranks. Bits are in
  /// ascending (dx, dy, dz); a voxel is no neighbour of itself.
  template <class Use>
  void for_each_voxel(std::size_t block, Use&& use) const {
    const cube::RowCell first = first_cell(index_.block(block).key);
    for (std::uint32_t part = 0; part < VoxelIndex::kBlockParts; ++part) {
      for_each_bit(index_.part(block, part).bits, [&](std::uint32_t bit) {
        const cube::RowCell at = kCellOfPlace[part * kPartPlaces + bit];
        use(first.cell() + at.cell(), around(first.row + at.row, first.z + at.z));
      });
    }
  }
  /// Calls use(rank) for neighbours of the voxel of a cell.
  template <class Use>
  void for_each_neighbour(int cell, std::uint32_t neighbours, Use&& use) const {
    for_each_bit(neighbours, [&](std::uint32_t i) { use(ranks_[static_cast<std::size_t>(cell + kOffsets[i])]); });
  }

 private:
  static constexpr int kSide = cube::kSide;
  static constexpr std::size_t kCells = kSide * kSide * kSide;
  static constexpr std::uint32_t kPartPlaces = 64;
  static constexpr auto kOffsets = cube::offsets();
  static constexpr auto kCellOfPlace = cube::cells_of_places();

  /// The first cell of the block at a place in the group or beside it.
  static cube::RowCell first_cell(int x, int y, int z) {
    constexpr int kBlock = VoxelIndex::kBlockSide;
    return cube::row_cell(1 + kBlock * x, 1 + kBlock * y, 1 + kBlock * z);
  }
  static cube::RowCell first_cell(const LatticePoint& block) {
    return first_cell(block.x & 1, block.y & 1, block.z & 1);
  }

  /// Calls use(bit number) for the bits that are set, lowest first.
  template <class Word, class Use>
  static void for_each_bit(Word word, Use&& use) {
    for (; word != 0; word &= word - 1) use(static_cast<std::uint32_t>(std::countr_zero(word)));
  }

  std::uint32_t around(int row, int z) const {
    const int below = z - 1;
    std::uint32_t bits = 0;
    for (int i = 0; i < 9; ++i) {
      const auto at = static_cast<std::size_t>(row + (i / 3 - 1) * kSide + i % 3 - 1);
      bits |= (rows_[at] >> below & 7U) << 3 * i;
    }
    return bits & ~(1U << cube::kAround / 2);
  }

  /// @param places  those of the block that are wanted, a word per part.
  void add(std::uint32_t block, const std::array<std::uint64_t, VoxelIndex::kBlockParts>& places, cube::RowCell first);
  /// Blocks come in Z-order: most of those around a group were around the one before.
  std::uint32_t find(const LatticePoint& block);

  struct Found {
    LatticePoint key;
    std::uint32_t index = 0;
    bool known = false;
  };

  const VoxelIndex& index_;
  std::vector<Found> recent_ = std::vector<Found>(2048);
  std::array<std::uint32_t, kSide * kSide> rows_{};  // A bit per cell.
  // Per cell; right where a bit says so.
  std::vector<std::uint32_t> ranks_ = std::vector<std::uint32_t>(kRanks ? kCells : 0);
};

extern template class VoxelCube<false>;
extern template class VoxelCube<true>;

}  // namespace arris::tiling
