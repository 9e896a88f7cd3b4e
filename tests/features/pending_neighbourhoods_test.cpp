// Neighbourhoods laid side by side are those that were put one after the other.

#include "features/segment/pending_neighbourhoods.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "features/numerics/transpose.h"

namespace arris {
namespace {

struct TransposeBlock {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const double* from, double* to) {
    using V = typename simd::Wide<Bytes>::Double;
    constexpr std::size_t kLanes = Bytes / sizeof(double);
    simd::transpose<V>(from, 10, to, kLanes);
  }
};

TEST(Transpose, EveryWidth) {
  std::array<double, 80> from{};
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<double>(i);
  for (int bytes = 16; bytes <= simd::widest_bytes(); bytes *= 2) {
    const std::size_t lanes = static_cast<std::size_t>(bytes) / sizeof(double);
    std::array<double, 64> to{};
    simd::dispatch_at<TransposeBlock>(bytes, from.data(), to.data());
    for (std::size_t row = 0; row < lanes; ++row)
      for (std::size_t column = 0; column < lanes; ++column)
        EXPECT_EQ(to[column * lanes + row], from[row * 10 + column]);
  }
}

Neighbours random_neighbours(std::size_t count, std::mt19937_64& random) {
  std::uniform_int_distribution<int> steps(-1000, 1000);
  Neighbours found;
  found.reserve(count);
  found.count = count;
  for (std::size_t i = 0; i < count; ++i) {
    found.dx[i] = steps(random), found.dy[i] = steps(random), found.dz[i] = steps(random);
    found.d2[i] = found.dx[i] * found.dx[i] + found.dy[i] * found.dy[i] + found.dz[i] * found.dz[i];
  }
  return found;
}

TEST(PendingNeighbourhoods, AreLaidSideBySide) {
  std::mt19937_64 random(1);
  for (const std::size_t size : {3U, 8U, 12U, 17U, 30U, 64U}) {
    PendingNeighbourhoods all(size), some(size);
    std::vector<Neighbours> put;
    while (!all.full()) {
      put.push_back(random_neighbours(size + 2, random));  // More than are taken.
      all.add(static_cast<std::uint32_t>(100 + put.size()), put.back());
    }
    for (const std::size_t lane : {5U, 2U, 15U}) some.add(all, lane);
    NeighbourhoodBatch batch;
    all.lay_out(batch);
    EXPECT_EQ(batch.neighbours, size);
    EXPECT_EQ(batch.lanes, kBatchLanes);
    const auto expect_lane = [&](std::size_t lane, const Neighbours& is) {
      double sum = 0.0;
      for (std::size_t i = 0; i < size; ++i) {
        EXPECT_EQ(batch.x[i][lane], is.dx[i]);
        EXPECT_EQ(batch.y[i][lane], is.dy[i]);
        EXPECT_EQ(batch.z[i][lane], is.dz[i]);
        sum += std::sqrt(is.d2[i]);
      }
      EXPECT_EQ(batch.mean_distance[lane], sum / static_cast<double>(size));
    };
    for (std::size_t lane = 0; lane < kBatchLanes; ++lane) expect_lane(lane, put[lane]);
    some.lay_out(batch);
    EXPECT_EQ(batch.lanes, 3U);
    EXPECT_EQ(some.slot(0), all.slot(5));
    expect_lane(0, put[5]);
    expect_lane(1, put[2]);
    expect_lane(2, put[15]);
  }
}

}  // namespace
}  // namespace arris
