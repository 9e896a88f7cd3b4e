// Records of the frontier in bytes and back.

#include "merge/frontier_coding.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>

#include "features/segment/tile_growth.h"

namespace arris::merge {
namespace {

constexpr std::size_t kHead = 4;

/// Records with 0 to k neighbours among `ids` different ids.
std::vector<std::uint32_t> random_records(std::size_t count, std::size_t k, std::uint32_t ids, std::mt19937& random) {
  std::vector<std::uint32_t> words;
  for (std::size_t i = 0; i < count; ++i) {
    words.insert(words.end(), {static_cast<std::uint32_t>(random() % ids), static_cast<std::uint32_t>(random()),
                               static_cast<std::uint32_t>(random()), static_cast<std::uint32_t>(i)});
    const std::size_t neighbours = random() % (k + 1);
    for (std::size_t n = 0; n < k; ++n)
      words.push_back(n < neighbours ? static_cast<std::uint32_t>(random() % ids) : TileGrowth::kNoId);
  }
  return words;
}

void expect_record(const FrontierPoint& p, std::span<const std::uint32_t> record) {
  RC_ASSERT(p.id == record[0]);
  RC_ASSERT((p.position == LatticePoint{static_cast<std::int32_t>(record[1]), static_cast<std::int32_t>(record[2]),
                                        static_cast<std::int32_t>(record[3])}));
  const auto neighbours = record.subspan(kHead);
  const auto end = std::find(neighbours.begin(), neighbours.end(), TileGrowth::kNoId);
  RC_ASSERT(std::equal(p.neighbours.begin(), p.neighbours.end(), neighbours.begin(), end));
}

RC_GTEST_PROP(FrontierCoding, WhatIsReadIsWhatWasWritten, ()) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const std::size_t k = *rc::gen::element(3, 8, 32, 64);
  // So few that all are recent, so many that some come back too late, and any.
  const std::uint32_t ids = *rc::gen::element(1U, 100U, 1000U, TileGrowth::kNoId);
  const std::size_t count = *rc::gen::inRange(0, 300);
  const auto words = random_records(count, k, ids, random);
  std::vector<std::byte> bytes;
  encode_frontier(words, kHead + k, bytes);
  std::vector<bool> dropped;
  if (*rc::gen::arbitrary<bool>())
    for (std::size_t i = 0; i < count; ++i) dropped.push_back(random() % 3 == 0);
  FrontierBlock block;
  RC_ASSERT(decode_frontier(bytes, count, dropped, block));
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!dropped.empty() && dropped[i]) continue;
    expect_record(block.point(at++), std::span(words).subspan(i * (kHead + k), kHead + k));
  }
  RC_ASSERT(block.size() == at);
}

TEST(FrontierCoding, NeighboursInCommon_TakeAByteEach) {
  constexpr std::size_t kStride = 4 + 8, kRecords = 1000;
  std::vector<std::uint32_t> words;
  for (std::uint32_t i = 0; i < kRecords; ++i) {
    words.insert(words.end(), {1000000 + i, i * 10, i * 10, 5});
    for (std::uint32_t n = 1; n <= 8; ++n) words.push_back(1000000 + i + n);
  }
  std::vector<std::byte> bytes;
  encode_frontier(words, kStride, bytes);
  EXPECT_LT(bytes.size(), kRecords * (1 + 3 + 1 + 8 + 1) + 100);
}

TEST(FrontierCoding, DamagedBytes_AreRefused) {
  std::mt19937 random(7);
  std::vector<std::byte> bytes;
  encode_frontier(random_records(50, 8, 1000, random), kHead + 8, bytes);
  FrontierBlock block;
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(decode_frontier(std::span(bytes).first(size), 50, {}, block));
  bytes.push_back(std::byte{0});
  EXPECT_FALSE(decode_frontier(bytes, 50, {}, block));
  // Any bytes at all: no more is asked than that nothing outside is touched.
  for (int i = 0; i < 200; ++i) {
    for (std::byte& b : bytes) b = static_cast<std::byte>(random());
    decode_frontier(bytes, 50, {}, block);
  }
}

}  // namespace
}  // namespace arris::merge
