#include "tiling/leaf_points.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <sstream>

#include "tiling/morton.h"
#include "tiling/point_grid.h"
#include "tiling/random_cloud.h"

namespace arris::tiling {
namespace {

using Points = std::vector<LatticePoint>;
using Ids = std::vector<std::uint64_t>;

/// A way through a stream and back is to be what a comparison sort says: by Z-order, equal positions by id.
void expect_sorted(const Points& points, const Ids& ids) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    return points[a] == points[b] ? ids[a] < ids[b] : z_order_less(points[a], points[b]);
  });
  std::stringstream stream;
  PointGrid(points, ids, {}).write(stream);
  const SortedPoints read = read_point_grid(stream);
  ASSERT_EQ(read.positions.size(), points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    ASSERT_EQ(read.positions[i], points[order[i]]) << i;
    ASSERT_EQ(read.ids[i], ids[order[i]]) << i;
  }
}

Ids shuffled_ids(std::size_t count, std::uint64_t seed) {
  Ids ids(count);
  std::iota(ids.begin(), ids.end(), std::uint64_t{1} << 40);
  std::mt19937_64 random(seed);
  std::shuffle(ids.begin(), ids.end(), random);
  return ids;
}

/// `wide` points in a cube of 2^12 steps, which one leaf can hold, make voxels large; the others are on a surface in
/// the lowest of these voxels.
Points cloud_with_full_voxel(std::size_t wide, std::size_t full, std::uint32_t side) {
  std::mt19937_64 random(full);
  Points points;
  const auto below = [&](std::uint64_t n) { return static_cast<std::int32_t>(random() % n); };
  for (std::size_t i = 0; i < wide; ++i) points.push_back({below(4096) - 4096, below(4096), below(4096)});
  for (std::size_t i = 0; i < full; ++i) {
    const std::int32_t x = below(side), y = below(side);
    points.push_back({x - 4096, y, (x + y) / 2});
  }
  return points;
}

class FullVoxel : public testing::TestWithParam<std::size_t> {};

TEST_P(FullVoxel, OfAnyNumberOfPoints_ComesBackInZOrder) {
  const Points points = cloud_with_full_voxel(2000, GetParam(), 128);
  expect_sorted(points, shuffled_ids(points.size(), 1));
}

// Around the numbers where another way of sorting begins; of the last, 65 537 and more are in one voxel.
INSTANTIATE_TEST_SUITE_P(Sizes, FullVoxel, testing::Values(1, 24, 28, 31, 32, 33, 65, 600, 20'000, 150'000));

TEST(LeafPoints, FewPositionsOfManyPoints_AreOrderedById) {
  for (const std::size_t full : {20U, 40U, 5000U, 70'000U}) {
    const Points points = cloud_with_full_voxel(100, full, 2);
    expect_sorted(points, shuffled_ids(points.size(), 2));
  }
}

TEST(LeafPoints, OnePositionOfManyPoints_IsOrderedById) {
  for (const std::size_t count : {1U, 2U, 33U, 70'000U}) {
    expect_sorted(Points(count, {-5, 7, 2'000'000'000}), shuffled_ids(count, 3));
  }
}

RC_GTEST_PROP(LeafPoints, AnyCloudOfShuffledIds_ComesBackInZOrder, ()) {
  const Points points = test::any_cloud(1, 3000);
  expect_sorted(points, shuffled_ids(points.size(), points.size()));
}

}  // namespace
}  // namespace arris::tiling
