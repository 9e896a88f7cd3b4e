#include "io/scalar_type.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/bytes.h"

namespace arris::io {
namespace {

constexpr std::array<std::size_t, 10> kTypeBytes{1, 1, 2, 2, 4, 4, 4, 8, 8, 8};
constexpr std::array<const char*, 10> kNames{"char", "uchar", "short",  "ushort", "int",
                                             "uint", "float", "double", "int64",  "uint64"};

template <typename T>
T nearest(double value) {
  if constexpr (std::is_floating_point_v<T>) return static_cast<T>(value);
  if (std::isnan(value)) return T{0};
  const double rounded = std::round(value);
  // The largest 64-bit integers are no doubles: compare with the power of two behind them.
  if (rounded >= std::ldexp(1.0, std::numeric_limits<T>::digits)) return std::numeric_limits<T>::max();
  if (rounded <= static_cast<double>(std::numeric_limits<T>::min())) return std::numeric_limits<T>::min();
  return static_cast<T>(rounded);
}

constexpr bool is_signed(ScalarType type) {
  return type == ScalarType::kInt8 || type == ScalarType::kInt16 || type == ScalarType::kInt32;
}

}  // namespace

std::size_t size_bytes(ScalarType type) {
  return kTypeBytes[static_cast<std::size_t>(type)];
}

const char* type_name(ScalarType type) {
  return kNames[static_cast<std::size_t>(type)];
}

double load_scalar(ScalarType type, const std::byte* at) {
  return with_scalar_type(type, [&](auto zero) { return static_cast<double>(load<decltype(zero)>(at)); });
}

void store_scalar(ScalarType type, double value, std::byte* at) {
  with_scalar_type(type, [&](auto zero) { store<decltype(zero)>(at, nearest<decltype(zero)>(value)); });
}

ScalarType common_type(ScalarType a, ScalarType b) {
  if (a == b) return a;
  if (size_bytes(a) == 8 || size_bytes(b) == 8) return ScalarType::kFloat64;
  const std::size_t most = std::max(size_bytes(a), size_bytes(b));
  if (!is_integer(a) || !is_integer(b)) {
    const std::size_t integer = is_integer(a) ? size_bytes(a) : is_integer(b) ? size_bytes(b) : 0;
    return integer == 4 ? ScalarType::kFloat64 : ScalarType::kFloat32;
  }
  if (is_signed(a) == is_signed(b)) return size_bytes(a) == most ? a : b;
  const std::size_t of_unsigned = is_signed(a) ? size_bytes(b) : size_bytes(a);
  const std::size_t needed = std::max(most, 2 * of_unsigned);
  return needed == 2 ? ScalarType::kInt16 : needed == 4 ? ScalarType::kInt32 : ScalarType::kFloat64;
}

}  // namespace arris::io
