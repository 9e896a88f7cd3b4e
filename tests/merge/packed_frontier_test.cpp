#include "merge/packed_frontier.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

#include "core/byte_packing.h"
#include "features/segment/tile_growth.h"

namespace arris::merge {
namespace {

constexpr std::size_t kHeadWords = 4;

/// Records of any values, with any number of neighbours.
std::vector<std::uint32_t> any_records(std::size_t stride) {
  std::vector<std::uint32_t> words;
  const auto records = *rc::gen::inRange<std::size_t>(0, 40).as("records");
  for (std::size_t r = 0; r < records; ++r) {
    const auto neighbours = *rc::gen::inRange<std::size_t>(0, stride - kHeadWords + 1);
    for (std::size_t i = 0; i < kHeadWords; ++i) words.push_back(*rc::gen::arbitrary<std::uint32_t>());
    for (std::size_t i = 0; i < neighbours; ++i)
      words.push_back(*rc::gen::suchThat<std::uint32_t>([](std::uint32_t id) { return id != TileGrowth::kNoId; }));
    words.resize((r + 1) * stride, TileGrowth::kNoId);
  }
  return words;
}

RC_GTEST_PROP(PackedFrontier, AnyRecords_ComeBack, ()) {
  const auto stride = *rc::gen::inRange<std::size_t>(kHeadWords, 40).as("stride");
  const std::vector<std::uint32_t> words = any_records(stride);
  std::vector<std::byte> packed(most_packed_bytes(words.size(), stride));
  const std::size_t bytes = pack_frontier(words, stride, packed.data());
  RC_ASSERT(bytes + kPackingSlackBytes <= packed.size());
  std::vector<std::uint32_t> back(words.size());
  RC_ASSERT(unpack_frontier(std::span(packed).first(bytes), stride, back));
  RC_ASSERT(back == words);
}

// AddressSanitizer sees what is read beyond the end.
RC_GTEST_PROP(PackedFrontier, OtherBytes_AreRefusedOrReadWithinBounds, ()) {
  const auto stride = *rc::gen::inRange<std::size_t>(kHeadWords, 40).as("stride");
  auto packed = *rc::gen::container<std::vector<std::uint8_t>>(rc::gen::arbitrary<std::uint8_t>());
  const std::size_t bytes = packed.size();
  packed.resize(bytes + kPackingSlackBytes);
  std::vector<std::uint32_t> words(stride * *rc::gen::inRange<std::size_t>(0, 10));
  static_cast<void>(unpack_frontier(std::as_bytes(std::span(packed)).first(bytes), stride, words));
}

TEST(PackedFrontier, NeighboursNearby_TakeFewBytes) {
  constexpr std::size_t kStride = 36;
  std::vector<std::uint32_t> words;
  for (std::uint32_t r = 0; r < 100; ++r) {
    const std::uint32_t id = 70'000'000 + 40 * r;
    words.insert(words.end(), {id, 100'000 + r, 200'000 - r, 300'000});
    for (std::uint32_t n = 0; n < kStride - kHeadWords; ++n) words.push_back(id + (n % 4) * 9'000 + n - 16);
  }
  std::vector<std::byte> packed(most_packed_bytes(words.size(), kStride));
  EXPECT_LT(pack_frontier(words, kStride, packed.data()), 90U * 100U);
}

}  // namespace
}  // namespace arris::merge
