#include "tiling/packed_points.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <vector>

#include "random_cloud.h"

namespace arris::tiling {
namespace {

/// Packed, with slack behind.
std::vector<std::byte> packed(const std::vector<SpooledPoint>& points, std::size_t& size) {
  std::vector<std::byte> bytes(points.size() * kMostPackedBytes + kPackingSlackBytes);
  size = pack_points(points, bytes.data());
  return bytes;
}

std::vector<SpooledPoint> any_points() {
  std::vector<SpooledPoint> points;
  for (const LatticePoint& position : test::any_cloud(0, 300))
    points.push_back({position, *rc::gen::arbitrary<std::uint64_t>()});
  return points;
}

RC_GTEST_PROP(PackedPoints, AnyPoints_ComeBack, ()) {
  const std::vector<SpooledPoint> points = any_points();
  std::size_t size = 0;
  const std::vector<std::byte> bytes = packed(points, size);
  RC_ASSERT(size >= points.size() * kLeastPackedBytes);
  RC_ASSERT(size <= points.size() * kMostPackedBytes);
  std::vector<LatticePoint> positions(points.size());
  std::vector<std::uint64_t> ids(points.size());
  RC_ASSERT(unpack_points(std::span(bytes).first(size), positions, ids));
  for (std::size_t i = 0; i < points.size(); ++i) {
    RC_ASSERT(positions[i] == points[i].position);
    RC_ASSERT(ids[i] == points[i].id);
  }
}

TEST(PackedPoints, FarthestApart_ComeBack) {
  constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min(),
                         kHigh = std::numeric_limits<std::int32_t>::max();
  const std::vector<SpooledPoint> points{
      {{kLow, kHigh, 0}, 0}, {{kHigh, kLow, -1}, std::numeric_limits<std::uint64_t>::max()}, {{kLow, kLow, kHigh}, 1}};
  std::size_t size = 0;
  const std::vector<std::byte> bytes = packed(points, size);
  std::vector<LatticePoint> positions(3);
  std::vector<std::uint64_t> ids(3);
  ASSERT_TRUE(unpack_points(std::span(bytes).first(size), positions, ids));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(positions[i], points[i].position);
    EXPECT_EQ(ids[i], points[i].id);
  }
}

// Whatever the bytes, nothing beyond the slack is read (AddressSanitizer looks), and a wrong number is noticed.
RC_GTEST_PROP(PackedPoints, OtherNumberOfPoints_IsRefused, ()) {
  const std::vector<SpooledPoint> points = any_points();
  std::size_t size = 0;
  std::vector<std::byte> bytes = packed(points, size);
  bytes.resize(size + kPackingSlackBytes);
  const auto other = *rc::gen::inRange<std::size_t>(0, 400);
  RC_PRE(other != points.size());
  std::vector<LatticePoint> positions(other);
  std::vector<std::uint64_t> ids(other);
  RC_ASSERT(!unpack_points(std::span(bytes).first(size), positions, ids));
}

TEST(PackedPoints, ScanLine_TakesFewBytes) {
  std::vector<SpooledPoint> points;
  for (std::int32_t i = 0; i < 1000; ++i)
    points.push_back({{5'000'000 + 9 * i, 70'000 - 3 * i, i % 7}, 1'000'000U + i});
  std::size_t size = 0;
  packed(points, size);
  EXPECT_LE(size, 5 * points.size() + kMostPackedBytes);
}

}  // namespace
}  // namespace arris::tiling
