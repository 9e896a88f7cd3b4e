#include "merge/packed_frontier.h"

#include <algorithm>
#include <array>

#include "core/byte_packing.h"
#include "features/segment/tile_growth.h"

namespace arris::merge {
namespace {

constexpr std::size_t kHeadWords = 4;  // Differ from those of the record before; ids of neighbours from the own id.
constexpr std::size_t kWordsPerControl = 4;

std::size_t controls_of(std::size_t words) {
  return (words + kWordsPerControl - 1) / kWordsPerControl;
}

}  // namespace

std::size_t most_packed_bytes(std::size_t words, std::size_t stride) {
  const std::size_t record = 1 + controls_of(stride) + stride * sizeof(std::uint32_t);
  return words / stride * record + kPackingSlackBytes;
}

std::size_t pack_frontier(std::span<const std::uint32_t> words, std::size_t stride, std::byte* out) {
  const std::byte* const begin = out;
  std::array<std::uint32_t, kHeadWords> before{};
  for (std::size_t first = 0; first < words.size(); first += stride) {
    const std::span<const std::uint32_t> record = words.subspan(first, stride);
    std::size_t used = stride;
    while (used > kHeadWords && record[used - 1] == TileGrowth::kNoId) --used;
    *out++ = static_cast<std::byte>(used);
    std::byte* const controls = out;
    std::fill_n(controls, controls_of(used), std::byte{0});
    out += controls_of(used);
    for (std::size_t i = 0; i < used; ++i) {
      const std::uint32_t coded = zigzag(record[i], i < kHeadWords ? before[i] : record[0]);
      const unsigned code = bytes_code(coded);
      controls[i / kWordsPerControl] |= static_cast<std::byte>(code << 2 * (i % kWordsPerControl));
      put_bytes(out, coded, code + 1);
    }
    std::copy_n(record.begin(), kHeadWords, before.begin());
  }
  return static_cast<std::size_t>(out - begin);
}

bool unpack_frontier(std::span<const std::byte> packed, std::size_t stride, std::span<std::uint32_t> words) {
  const std::byte* in = packed.data();
  const std::byte* const end = in + packed.size();
  std::array<std::uint32_t, kHeadWords> before{};
  for (std::size_t first = 0; first < words.size(); first += stride) {
    const std::span<std::uint32_t> record = words.subspan(first, stride);
    if (in == end) return false;
    const auto used = static_cast<std::size_t>(*in++);
    if (used < kHeadWords || used > stride) return false;
    const std::byte* const controls = in;
    if (static_cast<std::size_t>(end - in) < controls_of(used) + used) return false;
    in += controls_of(used);
    for (std::size_t i = 0; i < used; ++i) {
      if (in >= end) return false;
      const unsigned code = static_cast<unsigned>(controls[i / kWordsPerControl]) >> 2 * (i % kWordsPerControl) & 3;
      record[i] = unzigzag(get_bytes<std::uint32_t>(in, code + 1), i < kHeadWords ? before[i] : record[0]);
    }
    std::fill(record.begin() + static_cast<std::ptrdiff_t>(used), record.end(), TileGrowth::kNoId);
    std::copy_n(record.begin(), kHeadWords, before.begin());
  }
  return in == end;
}

}  // namespace arris::merge
