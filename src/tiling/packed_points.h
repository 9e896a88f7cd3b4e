#pragma once
/// @file Points with ids in as few bytes as their differences from the point before need: scans hold neighbours in
/// space beside each other.

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/byte_packing.h"
#include "core/lattice.h"

namespace arris::tiling {

/// Bytes of one packed point: a control byte, then x, y, z in 1 to 4 bytes each and the id in 1, 2, 4 or 8.
constexpr std::size_t kLeastPackedBytes = 5;
constexpr std::size_t kMostPackedBytes = 21;
/// A point before it is packed.
struct SpooledPoint {
  LatticePoint position;
  std::uint64_t id;
};

/// Packs points; any values are allowed. The first differs from a point at 0, 0, 0 with id 0.
/// @param out  kMostPackedBytes per point and kPackingSlackBytes. @return bytes that hold them.
std::size_t pack_points(std::span<const SpooledPoint> points, std::byte* out);

/// The reverse, for positions.size() points (ids as many).
/// @param packed  kPackingSlackBytes beyond its end may be read. @return whether the bytes were those of that many
/// points.
bool unpack_points(std::span<const std::byte> packed, std::span<LatticePoint> positions, std::span<std::uint64_t> ids);

}  // namespace arris::tiling
