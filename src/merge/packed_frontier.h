#pragma once
/// @file Records of the frontier in as few bytes as their differences need.

#include <cstddef>
#include <cstdint>
#include <span>

namespace arris::merge {

/// For records of `stride` words each (TileGrowth::frontier): id, x, y, z, then ids, filled up with kNoId. Slack
/// included (core/byte_packing.h).
std::size_t most_packed_bytes(std::size_t words, std::size_t stride);

/// @param words  whole records; at least 4 words each, at most 255. @param out  most_packed_bytes(). @return bytes
/// used.
std::size_t pack_frontier(std::span<const std::uint32_t> words, std::size_t stride, std::byte* out);

/// The reverse. @param packed  kPackingSlackBytes beyond its end may be read. @return whether the bytes were those of
/// so many words.
bool unpack_frontier(std::span<const std::byte> packed, std::size_t stride, std::span<std::uint32_t> words);

}  // namespace arris::merge
