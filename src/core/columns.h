#pragma once
/// @file The columns that arris adds to points, independent of any file format.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace arris {

/// Types that both LAS extra bytes and PLY properties carry, and that common viewers read well.
enum class ColumnType : std::uint8_t { kUint8, kUint16, kUint32, kFloat32 };

constexpr std::size_t size_bytes(ColumnType type) {
  return type == ColumnType::kUint8 ? 1 : type == ColumnType::kUint16 ? 2 : 4;
}

struct ColumnSpec {
  std::string name;  ///< At most 32 bytes (LAS), no spaces (PLY): "EdgeClass".
  ColumnType type;
  std::string description;  ///< At most 32 bytes.
};

/// Sum of the sizes: the values of one point are packed little-endian in the order of the columns, without padding.
inline std::size_t row_size_bytes(const std::vector<ColumnSpec>& columns) {
  std::size_t size = 0;
  for (const ColumnSpec& column : columns) size += size_bytes(column.type);
  return size;
}

/// Bits of EdgeClass.
enum EdgeClassBit : std::uint8_t {
  kBoundary = 1,
  kWeakBoundary = 2,
  kFold = 4,
  kSupervoxelContact = 8,
  kConvex = 16,   ///< A fold seen from outside of the angle between its surfaces: a ridge, a corner of a house.
  kConcave = 32,  ///< A fold seen from inside of it: a valley, the foot of a wall.
};

}  // namespace arris
