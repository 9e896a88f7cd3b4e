#include "core/byte_packing.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <vector>

namespace arris {
namespace {

std::vector<std::uint32_t> sevens_of(std::uint32_t value) {
  std::vector<std::uint32_t> bytes;
  put_sevens(value, [&](std::uint32_t byte) { bytes.push_back(byte); });
  return bytes;
}

/// @return whether the bytes were a number.
bool read_sevens(const std::vector<std::uint32_t>& bytes, std::uint32_t& value, std::size_t& used) {
  used = 0;
  return get_sevens(value, [&] { return bytes.at(used++); });
}

TEST(BytePacking, Sevens_TakeTheBytesThatTheyNeed) {
  EXPECT_EQ(sevens_of(0), (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(sevens_of(127), (std::vector<std::uint32_t>{127}));
  EXPECT_EQ(sevens_of(128), (std::vector<std::uint32_t>{0x80, 1}));
  EXPECT_EQ(sevens_of(300), (std::vector<std::uint32_t>{0xac, 2}));
  EXPECT_EQ(sevens_of((1U << 28) - 1).size(), 4U);
  EXPECT_EQ(sevens_of(1U << 28).size(), 5U);
  EXPECT_EQ(sevens_of(std::numeric_limits<std::uint32_t>::max()),
            (std::vector<std::uint32_t>{0xff, 0xff, 0xff, 0xff, 0x0f}));
}

TEST(BytePacking, Sevens_WithoutAnEnd_AreNoNumber) {
  std::uint32_t value = 0;
  std::size_t used = 0;
  EXPECT_FALSE(read_sevens({0x80, 0x80, 0x80, 0x80, 0x80, 0x00}, value, used));
  EXPECT_EQ(used, 5U);
}

RC_GTEST_PROP(BytePacking, Sevens_OfAnyNumber_ReadTheSame, (std::uint32_t number, std::uint8_t shift)) {
  const std::uint32_t value = number >> (shift % 32);
  const std::vector<std::uint32_t> bytes = sevens_of(value);
  std::uint32_t read = 0;
  std::size_t used = 0;
  RC_ASSERT(read_sevens(bytes, read, used));
  RC_ASSERT(read == value);
  RC_ASSERT(used == bytes.size());
}

RC_GTEST_PROP(BytePacking, Zigzag_OfAnyNumbers_GivesTheValueBack, (std::uint32_t value, std::uint32_t before)) {
  RC_ASSERT(unzigzag(zigzag(value, before), before) == value);
  RC_ASSERT(zigzag(before, before) == 0U);
}

TEST(BytePacking, Zigzag_OfNeighbours_IsSmall) {
  EXPECT_EQ(zigzag(6U, 5U), 2U);
  EXPECT_EQ(zigzag(4U, 5U), 1U);
  EXPECT_EQ(zigzag(0U, std::numeric_limits<std::uint32_t>::max()), 2U);  // Wraps around.
}

RC_GTEST_PROP(BytePacking, Bytes_OfAnyNumbers_ReadTheSameAndCountAsTold, (const std::vector<std::uint32_t>& numbers)) {
  std::vector<std::byte> bytes(numbers.size() * 4 + kPackingSlackBytes);
  std::byte* out = bytes.data();
  for (const std::uint32_t number : numbers) put_bytes(out, number, bytes_code(number) + 1);
  const std::byte* in = bytes.data();
  for (const std::uint32_t number : numbers) RC_ASSERT(get_bytes<std::uint32_t>(in, bytes_code(number) + 1) == number);
  RC_ASSERT(in == out);
}

TEST(BytePacking, BytesCode_AtEveryBorder_IsOneLessThanTheBytes) {
  EXPECT_EQ(bytes_code(0), 0U);
  EXPECT_EQ(bytes_code(0xff), 0U);
  EXPECT_EQ(bytes_code(0x100), 1U);
  EXPECT_EQ(bytes_code(0xffff), 1U);
  EXPECT_EQ(bytes_code(0x10000), 2U);
  EXPECT_EQ(bytes_code(0xffffff), 2U);
  EXPECT_EQ(bytes_code(0x1000000), 3U);
}

}  // namespace
}  // namespace arris
