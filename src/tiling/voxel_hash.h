#pragma once
/// @file Hash of voxel keys.

#include <cstdint>

#include "core/lattice.h"

namespace arris::tiling {

/// The upper 29 bits are well mixed and the same for the 2x2x2 keys of a cube, which the lower three tell apart: with
/// HashSlots the keys of a cube share a cache line. Only 32-bit operations, so that loops over arrays vectorise.
inline std::uint32_t voxel_hash(std::int32_t x, std::int32_t y, std::int32_t z) {
  std::uint32_t h = static_cast<std::uint32_t>(x >> 1) * 0x9E3779B1U +
                    static_cast<std::uint32_t>(y >> 1) * 0x85EBCA77U + static_cast<std::uint32_t>(z >> 1) * 0xC2B2AE3DU;
  h = (h ^ h >> 15) * 0x2C1B3C6DU;
  h = (h ^ h >> 12) * 0x297A2D39U;
  h ^= h >> 15;
  return (h & ~7U) | static_cast<std::uint32_t>((x & 1) << 2 | (y & 1) << 1 | (z & 1));
}
inline std::uint32_t voxel_hash(const LatticePoint& key) {
  return voxel_hash(key.x, key.y, key.z);
}

}  // namespace arris::tiling
