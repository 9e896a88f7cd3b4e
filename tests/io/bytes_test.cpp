// Copies of a few bytes.

#include "io/bytes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace arris::io {
namespace {

TEST(Bytes, ShortCopies_CopySoManyAndNoMore) {
  constexpr std::size_t kMost = 200;
  std::array<std::byte, kMost> from{};
  for (std::size_t i = 0; i < kMost; ++i) from[i] = static_cast<std::byte>(i + 1);
  for (std::size_t size = 0; size <= kMost; ++size) {
    std::array<std::byte, kMost + 2> to{};
    copy_short(to.data() + 1, from.data(), size);
    EXPECT_EQ(to[0], std::byte{}) << size;
    EXPECT_TRUE(std::equal(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(size), to.begin() + 1)) << size;
    EXPECT_TRUE(std::all_of(to.begin() + 1 + static_cast<std::ptrdiff_t>(size), to.end(), [](std::byte b) {
      return b == std::byte{};
    })) << size;
  }
}

}  // namespace
}  // namespace arris::io
