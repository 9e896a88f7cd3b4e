#include "merge/result_coding.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "core/columns.h"

namespace arris::merge {
namespace {

/// Any bits: NaN and minus zero are kept as well.
float any_float() {
  return *rc::gen::oneOf(
      rc::gen::just(0.0F), rc::gen::just(-0.0F),
      rc::gen::map(rc::gen::arbitrary<std::uint32_t>(), [](std::uint32_t bits) { return std::bit_cast<float>(bits); }));
}

ContourRecords any_records(std::uint64_t first_id) {
  ContourRecords records;
  const int count = *rc::gen::inRange(0, 50);
  for (int i = 0; i < count; ++i) {
    ContourRecord r;
    r.id = first_id + *rc::gen::oneOf(rc::gen::inRange<std::uint64_t>(0, 300),
                                      rc::gen::inRange<std::uint64_t>(0, 1U << 19),
                                      rc::gen::inRange<std::uint64_t>(0, std::uint64_t{1} << 32));
    r.classes = *rc::gen::arbitrary<std::uint8_t>();
    r.votes = *rc::gen::oneOf(rc::gen::inRange<std::uint32_t>(0, 300), rc::gen::arbitrary<std::uint32_t>());
    r.gap_deg = any_float();
    r.fold_strength = any_float();
    r.fold_angle_deg = any_float();
    r.score = any_float();
    for (float& axis : r.to_edge) axis = any_float();
    records.push_back(r);
  }
  std::sort(records.begin(), records.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return records;
}

bool same_bits(const ContourRecord& a, const ContourRecord& b) {
  const auto same = [](float x, float y) { return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y); };
  return a.id == b.id && a.classes == b.classes && a.votes == b.votes && same(a.gap_deg, b.gap_deg) &&
         same(a.fold_strength, b.fold_strength) && same(a.fold_angle_deg, b.fold_angle_deg) && same(a.score, b.score) &&
         std::equal(a.to_edge.begin(), a.to_edge.end(), b.to_edge.begin(), same);
}

RC_GTEST_PROP(ResultCoding, AnyRecords_AreReadAsWritten, ()) {
  const std::uint64_t first_id = *rc::gen::inRange<std::uint64_t>(0, std::uint64_t{1} << 40);
  const ContourRecords records = any_records(first_id);
  PageVector<std::byte> bytes;
  encode_results(records, first_id, bytes);
  ContourRecords read;
  RC_ASSERT(decode_results(bytes, records.size(), first_id, read));
  RC_ASSERT(read.size() == records.size());
  RC_ASSERT(std::equal(read.begin(), read.end(), records.begin(), same_bits));
}

RC_GTEST_PROP(ResultCoding, BytesCutOrChanged_AreRefusedOrReadWithinThem, ()) {
  const ContourRecords records = any_records(0);
  PageVector<std::byte> bytes;
  encode_results(records, 0, bytes);
  ContourRecords read;
  RC_ASSERT(records.empty() || !decode_results(bytes, records.size() - 1, 0, read));
  RC_ASSERT(!decode_results(bytes, records.size() + 1, 0, read));
  const auto kept = *rc::gen::inRange<std::size_t>(0, bytes.size() + 1);
  // In a block of its own, so that a sanitizer sees what is read past it.
  PageVector<std::byte> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(kept));
  cut.shrink_to_fit();
  RC_ASSERT(decode_results(cut, records.size(), 0, read) == (kept == bytes.size()));
  for (std::byte& byte : cut)
    if (*rc::gen::inRange(0, 8) == 0) byte = static_cast<std::byte>(*rc::gen::arbitrary<std::uint8_t>());
  decode_results(cut, records.size(), 0, read);
  RC_ASSERT(read.size() <= records.size());
}

/// Nothing is written past the room made for them: a sanitizer would see it.
TEST(ResultCoding, LargestRecords_AreReadAsWritten) {
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
  ContourRecords records;
  for (std::uint64_t i = 1; i <= 200; ++i)
    records.push_back({i << 24, 255, kMost, -1.0F, -2.0F, -3.0F, -4.0F, {-5.0F, -6.0F, -7.0F}});
  PageVector<std::byte> bytes;
  encode_results(records, 0, bytes);
  EXPECT_EQ(bytes.size(), records.size() * 39);
  ContourRecords read;
  ASSERT_TRUE(decode_results(bytes, records.size(), 0, read));
  EXPECT_TRUE(std::equal(read.begin(), read.end(), records.begin(), records.end(), same_bits));
}

TEST(ResultCoding, UsualRecords_TakeFewBytes) {
  PageVector<std::byte> bytes;
  encode_results(ContourRecords{{7, kBoundary, 0, 120.0F}}, 0, bytes);
  EXPECT_EQ(bytes.size(), 7U);
  encode_results(ContourRecords{{7, kFold, 30, 0.0F, 1.5F, 90.0F}}, 0, bytes);
  EXPECT_EQ(bytes.size(), 7U + 12U);
}

}  // namespace
}  // namespace arris::merge
