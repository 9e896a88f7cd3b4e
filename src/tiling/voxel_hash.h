#pragma once
/// @file Hash of voxel keys.

#include <cstddef>
#include <cstdint>

#include "core/lattice.h"

namespace arris::tiling {

/// 32 well mixed bits; only 32-bit operations, so that loops over arrays vectorise.
inline std::uint32_t voxel_hash(std::int32_t x, std::int32_t y, std::int32_t z) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9E3779B1U + static_cast<std::uint32_t>(y) * 0x85EBCA77U +
                    static_cast<std::uint32_t>(z) * 0xC2B2AE3DU;
  h = (h ^ h >> 15) * 0x2C1B3C6DU;
  h = (h ^ h >> 12) * 0x297A2D39U;
  return h ^ h >> 15;
}
inline std::uint32_t voxel_hash(const LatticePoint& key) {
  return voxel_hash(key.x, key.y, key.z);
}

/// Slot of a table of `slots` slots, from the upper bits of the hash.
inline std::size_t home_slot(std::uint32_t hash, std::size_t slots) {
  return static_cast<std::size_t>(std::uint64_t{hash} * slots >> 32);
}

}  // namespace arris::tiling
