#pragma once
/// @file Square blocks of cells, sparse, by their place in the plane.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>

namespace arris {

/// Cells along the side of a block: block (i, j) holds the cells [16 i, 16 i + 16) x [16 j, 16 j + 16).
constexpr int kGroundBlockBits = 4;
constexpr int kGroundBlockSide = 1 << kGroundBlockBits;
constexpr std::size_t kGroundBlockCells = std::size_t{1} << (2 * kGroundBlockBits);

/// Place of a cell in its block.
constexpr std::size_t ground_cell_index(std::int64_t x, std::int64_t y) {
  return static_cast<std::size_t>((y & (kGroundBlockSide - 1)) << kGroundBlockBits | (x & (kGroundBlockSide - 1)));
}

struct GroundBlockKey {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend bool operator==(const GroundBlockKey&, const GroundBlockKey&) = default;
};

/// Block of a cell.
constexpr GroundBlockKey ground_block_of(std::int64_t cell_x, std::int64_t cell_y) {
  return {static_cast<std::int32_t>(cell_x >> kGroundBlockBits), static_cast<std::int32_t>(cell_y >> kGroundBlockBits)};
}

struct GroundBlockHash {
  std::size_t operator()(const GroundBlockKey& key) const {
    const std::uint64_t packed =
        std::uint64_t{static_cast<std::uint32_t>(key.x)} << 32 | static_cast<std::uint32_t>(key.y);
    return static_cast<std::size_t>((packed * 0x9E3779B97F4A7C15U) >> 20);
  }
};

/// Iteration has no order that means anything: what is done to a block must not depend on it.
template <class Block>
using GroundBlocks = std::unordered_map<GroundBlockKey, std::unique_ptr<Block>, GroundBlockHash>;

}  // namespace arris
