// Rows of neighbours against what was put.

#include "features/segment/neighbour_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/parallel.h"

namespace arris {
namespace {

using Rows = std::vector<std::vector<std::uint32_t>>;

void expect_equal(const NeighbourRows& rows, const Rows& expected) {
  for (std::uint32_t slot = 0; slot < expected.size(); ++slot) {
    const NeighbourList list = rows[slot];
    ASSERT_EQ(std::vector<std::uint32_t>(list.begin(), list.end()), expected[slot]) << slot;
    ASSERT_EQ(rows.count(slot), expected[slot].size());
    if (expected[slot].empty()) continue;
    ASSERT_EQ(rows.last(slot), expected[slot].back());
    for (std::size_t i = 0; i < expected[slot].size(); ++i) ASSERT_EQ(rows.at(slot, i), expected[slot][i]);
  }
}

TEST(NeighbourRows, DifferencesUpToTheBorderOf16Bits_AreRead) {
  constexpr std::uint32_t kSlots = 100'000, kSlot = 40'000;
  for (const std::int32_t difference : {-32'769, -32'768, -1, 1, 32'767, 32'768}) {
    NeighbourRows rows(kSlots, 3);
    Rows expected(kSlots);
    expected[kSlot] = {kSlot + 1, kSlot + static_cast<std::uint32_t>(difference)};
    NeighbourRows::Writer(rows).put(kSlot, 2, [&](std::size_t i) { return expected[kSlot][i]; });
    expect_equal(rows, expected);
  }
}

TEST(NeighbourRows, ManyWriters_EachRowIsWhatWasPut) {
  constexpr std::uint32_t kSlots = 200'000;
  for (const std::size_t most : {3U, 8U, 30U, 64U}) {
    std::mt19937 random(static_cast<unsigned>(most));
    Rows expected(kSlots);
    for (std::uint32_t slot = 0; slot < kSlots; ++slot) {
      if (random() % 8 == 0) continue;
      expected[slot].resize(random() % (most + 1));
      const bool far = random() % 4 == 0;
      for (std::uint32_t& neighbour : expected[slot])
        neighbour = far ? static_cast<std::uint32_t>(random() % kSlots)
                        : std::min(kSlots - 1, slot + static_cast<std::uint32_t>(random() % 1000));
    }
    NeighbourRows rows(kSlots, most);
    parallel_for_chunks(kSlots, 1000, [&](std::size_t first, std::size_t last) {
      NeighbourRows::Writer writer(rows);
      for (std::size_t slot = first; slot < last; ++slot)
        if (!expected[slot].empty())
          writer.put(static_cast<std::uint32_t>(slot), expected[slot].size(),
                     [&](std::size_t i) { return expected[slot][i]; });
    });
    expect_equal(rows, expected);
  }
}

}  // namespace
}  // namespace arris
