#pragma once
/// @file The scalar types of attributes, named as PLY names them.

#include <cstddef>
#include <cstdint>

#include "core/columns.h"

namespace arris::io {

enum class ScalarType : std::uint8_t {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat32,
  kFloat64,
  kInt64,
  kUint64
};

std::size_t size_bytes(ScalarType type);
constexpr ScalarType scalar_type(ColumnType type) {
  return type == ColumnType::kUint8    ? ScalarType::kUint8
         : type == ColumnType::kUint16 ? ScalarType::kUint16
         : type == ColumnType::kUint32 ? ScalarType::kUint32
                                       : ScalarType::kFloat32;
}
constexpr bool is_integer(ScalarType type) {
  return type != ScalarType::kFloat32 && type != ScalarType::kFloat64;
}
/// The name most readers of PLY know: "uchar", "float", ...
const char* type_name(ScalarType type);

/// Calls use with a zero of the C++ type that the scalar type names, and returns what it returns.
template <typename Use>
auto with_scalar_type(ScalarType type, Use&& use) {
  switch (type) {
    case ScalarType::kInt8:
      return use(std::int8_t{});
    case ScalarType::kUint8:
      return use(std::uint8_t{});
    case ScalarType::kInt16:
      return use(std::int16_t{});
    case ScalarType::kUint16:
      return use(std::uint16_t{});
    case ScalarType::kInt32:
      return use(std::int32_t{});
    case ScalarType::kUint32:
      return use(std::uint32_t{});
    case ScalarType::kFloat32:
      return use(float{});
    case ScalarType::kInt64:
      return use(std::int64_t{});
    case ScalarType::kUint64:
      return use(std::uint64_t{});
    case ScalarType::kFloat64:
      break;
  }
  return use(double{});
}

/// Little-endian value as double; 64-bit integers beyond 2^53 are rounded.
double load_scalar(ScalarType type, const std::byte* at);
/// Writes a value in little-endian. Integers get the nearest value of their range, NaN becomes their 0.
void store_scalar(ScalarType type, double value, std::byte* at);

/// The smallest type that holds all values of both. 64-bit integers and mixtures with them become double.
ScalarType common_type(ScalarType a, ScalarType b);

}  // namespace arris::io
