#pragma once
/// @file Numbers in as few bytes as they need.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace arris {

static_assert(std::endian::native == std::endian::little, "the low bytes of a word come first");

/// put_bytes() and get_bytes() copy whole words: buffers are longer by this.
constexpr std::size_t kPackingSlackBytes = 8;

/// The difference of two numbers, small if they are near each other either way; it wraps around.
template <class Unsigned>
constexpr Unsigned zigzag(Unsigned value, Unsigned before) {
  const Unsigned difference = value - before;
  return static_cast<Unsigned>(difference << 1) ^ (Unsigned{0} - (difference >> (8 * sizeof(Unsigned) - 1)));
}
/// The number that zigzag() made `coded` of.
template <class Unsigned>
constexpr Unsigned unzigzag(Unsigned coded, Unsigned before) {
  return before + ((coded >> 1) ^ (Unsigned{0} - (coded & 1)));
}

/// Bytes that hold a value, less one: 0 to 3.
constexpr unsigned bytes_code(std::uint32_t value) {
  return unsigned{value > 0xff} + unsigned{value > 0xffff} + unsigned{value > 0xffffff};
}

/// Writes the low `bytes` bytes of a value and moves on by as many.
template <class Word>
void put_bytes(std::byte*& out, Word value, unsigned bytes) {
  std::memcpy(out, &value, sizeof(Word));
  out += bytes;
}
/// The reverse. @param bytes  1 to sizeof(Word).
template <class Word>
Word get_bytes(const std::byte*& in, unsigned bytes) {
  Word value;
  std::memcpy(&value, in, sizeof(Word));
  in += bytes;
  const unsigned unused = 8 * (static_cast<unsigned>(sizeof(Word)) - bytes);
  return static_cast<Word>(value << unused) >> unused;
}

/// Puts a number in sevens of bits, lowest first, by put(std::uint32_t byte): 1 to 5 bytes, all but the last with the
/// bit 0x80.
template <class Put>
constexpr void put_sevens(std::uint32_t value, Put&& put) {
  for (; value >= 0x80; value >>= 7) put((value & 0x7f) | 0x80);
  put(value);
}
/// The reverse; bytes come from get(). @return false if five bytes are no number's end.
template <class Get>
constexpr bool get_sevens(std::uint32_t& value, Get&& get) {
  value = 0;
  for (int shift = 0; shift < 35; shift += 7) {
    const std::uint32_t byte = get();
    value |= (byte & 0x7f) << shift;
    if (byte < 0x80) return true;
  }
  return false;
}

}  // namespace arris
