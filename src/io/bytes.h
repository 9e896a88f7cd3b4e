#pragma once
/// @file Unaligned loads and stores of fixed byte order, and arithmetic that cannot wrap.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <type_traits>

namespace arris::io {

/// The value with its bytes in reverse order. Floating-point values are never reversed as such, so that no NaN is
/// altered.
template <typename T>
requires std::is_unsigned_v<T> T byte_reversed(T value) {
  if constexpr (sizeof(T) == 1) return value;
  if constexpr (sizeof(T) == 2) return __builtin_bswap16(value);
  if constexpr (sizeof(T) == 4) return __builtin_bswap32(value);
  if constexpr (sizeof(T) == 8) return __builtin_bswap64(value);
}

namespace detail {
template <std::size_t kSize>
using UnsignedOf = std::conditional_t<
    kSize == 1, std::uint8_t,
    std::conditional_t<kSize == 2, std::uint16_t, std::conditional_t<kSize == 4, std::uint32_t, std::uint64_t>>>;
}  // namespace detail

/// Reads sizeof(T) bytes at any address.
template <typename T, std::endian kOrder = std::endian::little>
T load(const std::byte* at) {
  detail::UnsignedOf<sizeof(T)> bits;
  std::memcpy(&bits, at, sizeof bits);
  if constexpr (kOrder != std::endian::native) bits = byte_reversed(bits);
  return std::bit_cast<T>(bits);
}

/// Writes sizeof(T) bytes at any address.
template <typename T, std::endian kOrder = std::endian::little>
void store(std::byte* at, T value) {
  auto bits = std::bit_cast<detail::UnsignedOf<sizeof(T)>>(value);
  if constexpr (kOrder != std::endian::native) bits = byte_reversed(bits);
  std::memcpy(at, &bits, sizeof bits);
}

/// As memcpy(), without a call: for a few dozen bytes, the number of which is known at run time only.
inline void copy_short(std::byte* to, const std::byte* from, std::size_t size_bytes) {
  const auto ends = [&]<std::size_t kSize> {  // They overlap.
    std::memcpy(to, from, kSize);
    std::memcpy(to + size_bytes - kSize, from + size_bytes - kSize, kSize);
  };
  while (size_bytes > 32) {
    std::memcpy(to, from, 16);
    to += 16, from += 16, size_bytes -= 16;
  }
  if (size_bytes >= 16) return ends.template operator()<16>();
  if (size_bytes >= 8) return ends.template operator()<8>();
  if (size_bytes >= 4) return ends.template operator()<4>();
  for (std::size_t i = 0; i < size_bytes; ++i) to[i] = from[i];
}

/// Text of a fixed field: up to its first NUL, or all of it.
inline std::string_view field_text(const std::byte* at, std::size_t size_bytes) {
  const std::string_view whole(reinterpret_cast<const char*>(at), size_bytes);
  return whole.substr(0, whole.find('\0'));
}

/// Copies `text` into a fixed field, cut or padded with NUL.
inline void store_text(std::byte* at, std::size_t size_bytes, std::string_view text) {
  std::memset(at, 0, size_bytes);
  std::memcpy(at, text.data(), text.size() < size_bytes ? text.size() : size_bytes);
}

/// a + b and a * b, or nothing if the result does not fit 64 bits.
inline std::optional<std::uint64_t> checked_add(std::uint64_t a, std::uint64_t b) {
  std::uint64_t sum = 0;
  return __builtin_add_overflow(a, b, &sum) ? std::nullopt : std::optional(sum);
}
inline std::optional<std::uint64_t> checked_multiply(std::uint64_t a, std::uint64_t b) {
  std::uint64_t product = 0;
  return __builtin_mul_overflow(a, b, &product) ? std::nullopt : std::optional(product);
}

}  // namespace arris::io
