#pragma once
/// @file Leaves of a CellTree met lately. Private to CellGrid: includes OpenVDB.

#include <array>
#include <cstddef>
#include <cstdint>

#include "tiling/cell_tree.h"

namespace arris::tiling {

/// Found by a hash of their position: most points need no walk down the tree, nor a look at the leaf to know where its
/// counts are.
class CellLeafCache {
 public:
  struct Entry {
    openvdb::Int32* counts = nullptr;
    CellLeaf* leaf = nullptr;
    std::int32_t x = 0, y = 0, z = 0;  ///< Cells >> kCellLeafLog2.
  };

  const Entry* find(std::int32_t x, std::int32_t y, std::int32_t z) const {
    const Entry& entry = entries_[slot(x, y, z)];
    return entry.leaf && entry.x == x && entry.y == y && entry.z == z ? &entry : nullptr;
  }
  const Entry& put(std::int32_t x, std::int32_t y, std::int32_t z, CellLeaf& leaf) {
    return entries_[slot(x, y, z)] = {leaf.buffer().data(), &leaf, x, y, z};
  }
  void clear() { entries_.fill({}); }

 private:
  static std::size_t slot(std::int32_t x, std::int32_t y, std::int32_t z) {
    const std::uint32_t hash = static_cast<std::uint32_t>(x) * 0x9E3779B1U ^
                               static_cast<std::uint32_t>(y) * 0x85EBCA77U ^
                               static_cast<std::uint32_t>(z) * 0xC2B2AE3DU;
    return hash >> 22;
  }
  std::array<Entry, 1024> entries_{};
};

}  // namespace arris::tiling
