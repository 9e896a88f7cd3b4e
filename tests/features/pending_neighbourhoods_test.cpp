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

using Offsets = std::vector<PackedNeighbours::Offset>;

Offsets random_offsets(std::size_t count, std::mt19937_64& random) {
  std::uniform_int_distribution<int> steps(-1000, 1000);
  Offsets offsets(count);
  for (auto& [x, y, z] : offsets) x = steps(random), y = steps(random), z = steps(random);
  return offsets;
}

PackedNeighbours found_of(const Offsets& offsets, bool narrow, std::mt19937_64& random) {
  PackedNeighbours found;
  found.reserve(offsets.size());
  found.count = offsets.size();
  found.narrow = narrow;
  if (!narrow) found.wide.reserve(offsets.size());
  std::uniform_int_distribution<int> steps(-1000, 1000);
  const auto qx = static_cast<float>(steps(random)), qy = static_cast<float>(steps(random));
  found.rows[0] = {qx, qy, 0.0F, 0};
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const auto [x, y, z] = offsets[i];
    if (narrow) {
      found.rows[i + 1] = {qx + static_cast<float>(x), qy + static_cast<float>(y), static_cast<float>(z), 7};
    } else {
      found.wide.dx[i] = x, found.wide.dy[i] = y, found.wide.dz[i] = z, found.wide.d2[i] = offsets[i].squared();
    }
  }
  return found;
}

void expect_lane(const NeighbourhoodBatch& batch, std::size_t lane, const Offsets& offsets) {
  double sum = 0.0;
  for (std::size_t i = 0; i < batch.neighbours; ++i) {
    EXPECT_EQ(batch.x[i][lane], offsets[i].x);
    EXPECT_EQ(batch.y[i][lane], offsets[i].y);
    EXPECT_EQ(batch.z[i][lane], offsets[i].z);
    sum += std::sqrt(offsets[i].squared());
  }
  EXPECT_EQ(batch.mean_distance[lane], sum / static_cast<double>(batch.neighbours));
}

/// What kinds of neighbourhoods there are, in turn.
void expect_laid_side_by_side(std::size_t size, const std::vector<bool>& narrow) {
  std::mt19937_64 random(size);
  PendingNeighbourhoods all(size), some(size);
  NeighbourhoodBatch batch;
  for (int round = 0; round < 3; ++round) {  // What was there before must not matter.
    std::vector<Offsets> put;
    while (!all.full()) {
      put.push_back(random_offsets(size + 2, random));  // More than are taken.
      PackedNeighbours found = found_of(put.back(), narrow[put.size() % narrow.size()], random);
      all.add(static_cast<std::uint32_t>(100 + put.size()), found);
    }
    all.lay_out(batch);
    EXPECT_EQ(batch.neighbours, size);
    EXPECT_EQ(batch.lanes, kBatchLanes);
    for (std::size_t lane = 0; lane < kBatchLanes; ++lane) expect_lane(batch, lane, put[lane]);
    for (const std::size_t lane : {5U, 2U, 15U}) some.add(all, lane);
    EXPECT_EQ(some.slot(0), all.slot(5));
    all.clear();
    some.lay_out(batch);
    EXPECT_EQ(batch.lanes, 3U);
    expect_lane(batch, 0, put[5]);
    expect_lane(batch, 1, put[2]);
    expect_lane(batch, 2, put[15]);
    some.clear();
    // Lanes that are not in use are finite.
    for (std::size_t lane = 0; lane < kBatchLanes; ++lane) EXPECT_GT(batch.mean_distance[lane], 0.0);
  }
}

TEST(PendingNeighbourhoods, AreLaidSideBySide) {
  for (const std::size_t size : {3U, 8U, 12U, 17U, 30U, 64U}) {
    expect_laid_side_by_side(size, {true});
    expect_laid_side_by_side(size, {false});
    expect_laid_side_by_side(size, {true, true, false});
  }
}

}  // namespace
}  // namespace arris
