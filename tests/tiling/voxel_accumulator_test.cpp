#include "tiling/voxel_accumulator.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "support/temp_folder.h"
#include "tiling/random_cloud.h"
#include "tiling/voxel_file.h"
#include "tiling/voxel_oracle.h"
#include "tiling/voxel_sums.h"
#include "tiling/voxel_table.h"

namespace arris::tiling {
namespace {

constexpr std::int32_t kMin = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();

std::vector<Voxel> all_voxels(const VoxelStore& store) {
  std::vector<Voxel> voxels;
  std::vector<std::uint32_t> ranks;
  store.load(store.index().bounds(), voxels, ranks);
  for (std::size_t i = 0; i < ranks.size(); ++i) EXPECT_EQ(ranks[i], i);
  EXPECT_EQ(voxels.size(), store.size());
  return voxels;
}

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

std::vector<RawColour> random_colours(std::mt19937_64& random, std::size_t size) {
  std::vector<RawColour> colours(size);
  const std::uint64_t most = random() % 2 ? 65536 : 256;
  for (RawColour& colour : colours) {
    for (std::uint16_t& channel : colour) channel = static_cast<std::uint16_t>(random() % most);
  }
  return colours;
}

/// Adds the points in batches of random sizes.
void add_in_batches(VoxelAccumulator& accumulator, std::mt19937_64& random, std::span<const LatticePoint> points,
                    std::span<const RawColour> colours) {
  while (!points.empty()) {
    const std::size_t size = std::min<std::size_t>(points.size(), random() % 700);
    accumulator.add(points.first(size), colours.empty() ? colours : colours.first(size));
    points = points.subspan(size);
    if (!colours.empty()) colours = colours.subspan(size);
  }
}

/// The same as a stream, some of the batches empty.
void add_as_stream(VoxelAccumulator& accumulator, std::mt19937_64& random, std::span<const LatticePoint> points,
                   std::span<const RawColour> colours) {
  accumulator.add_all([&](VoxelPoints& batch) {
    if (points.empty()) return false;
    const std::size_t size = std::min<std::size_t>(points.size(), random() % 3 ? random() % 700 : 0);
    batch.positions.assign(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(size));
    points = points.subspan(size);
    if (colours.empty()) return true;
    batch.colours.assign(colours.begin(), colours.begin() + static_cast<std::ptrdiff_t>(size));
    colours = colours.subspan(size);
    return true;
  });
}

/// Enough voxels that several threads sort them, that runs are written behind and that the store is filled in parts.
TEST(VoxelAccumulator, SeveralThreads_GiveTheVoxelsOfOne) {
  std::mt19937_64 random(31);
  const auto coordinate = [&] { return static_cast<std::int32_t>(random() % 2000) - 1000; };
  std::vector<LatticePoint> points(300'000);
  for (LatticePoint& p : points) p = {coordinate(), coordinate(), coordinate()};
  const auto colours = random_colours(random, points.size());
  const auto voxels_by = [&](int threads, std::size_t table_bytes, std::size_t likely_voxels) {
    const test::TempFolder folder;
    const ThreadLimit limit(threads);
    VoxelAccumulator accumulator(VoxelGrid(30), {folder.path(), table_bytes, ~std::uint64_t{0}, likely_voxels});
    accumulator.add(points, colours);
    const std::vector<Voxel> voxels = all_voxels(accumulator.finish());
    const test::TempFolder other;
    VoxelAccumulator streamed(VoxelGrid(30), {other.path(), table_bytes, ~std::uint64_t{0}, likely_voxels});
    add_as_stream(streamed, random, points, colours);
    EXPECT_EQ(all_voxels(streamed.finish()), voxels);
    return voxels;
  };
  const std::vector<Voxel> expected = voxels_by(1, 64 << 20, 0);
  ASSERT_GT(expected.size(), 150'000U);
  EXPECT_EQ(voxels_by(4, 64 << 20, 0), expected);
  EXPECT_EQ(voxels_by(4, 64 << 20, expected.size()), expected);
  EXPECT_EQ(voxels_by(4, 64 << 20, 1000), expected);
  EXPECT_EQ(voxels_by(4, 3 << 20, 0), expected);
}

RC_GTEST_PROP(VoxelAccumulator, AnyCloudOrderBatchesAndTable_GivesTheVoxelsOfTheDefinition, ()) {
  auto points = test::any_cloud(0, 4000);
  const auto side = *rc::gen::oneOf(rc::gen::inRange<std::int32_t>(1, 50), rc::gen::inRange<std::int32_t>(1, 5000),
                                    rc::gen::just(kMostVoxelSide))
                         .as("side");
  // From a dozen sums a run, merged two by two, to no runs at all.
  const auto table_bytes = *rc::gen::element<std::size_t>(1500, 4096, 40'000, 300'000, 1 << 20).as("table bytes");
  const bool coloured = *rc::gen::arbitrary<bool>().as("coloured");
  const auto seed = *rc::gen::arbitrary<std::uint64_t>().as("order seed");
  const ThreadLimit limit(*rc::gen::element(1, 2, 4).as("threads"));
  const auto streamed = *rc::gen::arbitrary<bool>().as("streamed");
  std::mt19937_64 random(seed);
  if (random() % 2) std::ranges::shuffle(points, random);
  const auto colours = coloured ? random_colours(random, points.size()) : std::vector<RawColour>{};

  const test::TempFolder folder;
  {
    VoxelAccumulator accumulator(VoxelGrid(side), {folder.path(), table_bytes});
    if (streamed) {
      add_as_stream(accumulator, random, points, colours);
    } else {
      add_in_batches(accumulator, random, points, colours);
    }
    const VoxelStore store = accumulator.finish();
    const auto expected = test::voxels_of(side, points, colours);
    RC_ASSERT(store.size() == expected.size());
    RC_ASSERT(all_voxels(store) == expected);
    RC_ASSERT(store.points() == points.size());
    std::uint16_t largest = 0;
    for (const RawColour& c : colours) largest = std::max({largest, c[0], c[1], c[2]});
    RC_ASSERT(store.largest_colour() == largest);
    RC_ASSERT(store.grid().side_steps() == side);
    RC_ASSERT(store.bytes_on_disk() == expected.size() * VoxelLayout(VoxelGrid(side), !colours.empty()).bytes());
    RC_ASSERT(accumulator.bytes_on_disk() >= store.bytes_on_disk());
    RC_ASSERT(files_in(folder.path()) == 1U);  // The runs are gone.
  }
  RC_ASSERT(files_in(folder.path()) == 0U);
}

RC_GTEST_PROP(VoxelAccumulator, PointsWithoutColoursAmongOthers_CountAsBlack, (std::uint64_t seed)) {
  const auto points = test::random_cloud(seed, 2000);
  std::mt19937_64 random(seed);
  auto colours = random_colours(random, points.size());
  const auto table_bytes = *rc::gen::element<std::size_t>(4096, 30'000, 1 << 20);
  const test::TempFolder folder;
  VoxelAccumulator accumulator(VoxelGrid(100), {folder.path(), table_bytes});
  for (std::size_t done = 0; done < points.size();) {
    const std::size_t size = std::min<std::size_t>(points.size() - done, 1 + random() % 400);
    const auto part = std::span(points).subspan(done, size);
    if (done == 0 || random() % 2) {
      accumulator.add(part);
      std::fill_n(colours.begin() + static_cast<std::ptrdiff_t>(done), size, RawColour{});
    } else {
      accumulator.add(part, std::span(colours).subspan(done, size));
    }
    done += size;
  }
  RC_ASSERT(all_voxels(accumulator.finish()) == test::voxels_of(100, points, colours));
}

TEST(VoxelAccumulator, EverythingInTheTable_NeverTouchesRunFiles) {
  const test::TempFolder folder;
  VoxelAccumulator accumulator(VoxelGrid(10), {folder.path(), 1 << 20});
  accumulator.add(test::random_cloud(1, 5000));
  EXPECT_EQ(files_in(folder.path()), 0U);
  EXPECT_EQ(accumulator.bytes_on_disk(), 0U);
  const VoxelStore store = accumulator.finish();
  EXPECT_EQ(accumulator.bytes_on_disk(), store.bytes_on_disk());
}

TEST(VoxelAccumulator, NoPoints_GiveAnEmptyStore) {
  const test::TempFolder folder;
  VoxelAccumulator accumulator(VoxelGrid(10), {folder.path(), 1 << 20});
  accumulator.add({});
  const VoxelStore store = accumulator.finish();
  EXPECT_EQ(store.size(), 0U);
  EXPECT_EQ(store.points(), 0U);
  EXPECT_TRUE(store.index().bounds().empty());
  EXPECT_TRUE(all_voxels(store).empty());
}

TEST(VoxelAccumulator, OnePoint_IsItsVoxelsMean) {
  const test::TempFolder folder;
  VoxelAccumulator accumulator(VoxelGrid(30), {folder.path(), 1 << 20});
  accumulator.add(std::vector<LatticePoint>{{-1, 31, 0}}, std::vector<RawColour>{{1, 2, 65535}});
  const VoxelStore store = accumulator.finish();
  EXPECT_EQ(store.largest_colour(), 65535);
  const Voxel expected{{0, 1, 0}, {14 * 16, 16 * 16, 15 * 16}, {1, 2, 65535}};
  EXPECT_EQ(all_voxels(store), (std::vector<Voxel>{expected}));
}

TEST(VoxelAccumulator, VoxelsAtTheEndsOfTheLattice_AreExact) {
  std::vector<LatticePoint> points;
  for (const std::int32_t x : {kMin, kMin + 1, -1, 0, kMax - 1, kMax}) {
    for (const std::int32_t y : {kMin, 0, kMax}) {
      for (const std::int32_t z : {kMin, -1, kMax}) points.push_back({x, y, z});
    }
  }
  for (const std::int32_t side : {1, 7, 1 << 20}) {
    const test::TempFolder folder;
    VoxelAccumulator accumulator(VoxelGrid(side), {folder.path(), 2000});
    accumulator.add(points);
    EXPECT_EQ(all_voxels(accumulator.finish()), test::voxels_of(side, points, {})) << side;
  }
}

constexpr std::int32_t kHalf = 1 << 19;  // Of the largest voxel.

TEST(VoxelAccumulator, MillionsOfPointsInTheLargestVoxel_AreSummedExactly) {
  // Sums far beyond 32 bits: 4096 points fill one.
  const std::vector<LatticePoint> batch(1 << 16, {-kHalf - 1, kHalf - 1, 7 - kHalf});
  const std::vector<RawColour> colours(batch.size(), {65535, 65534, 3});
  for (const bool coloured : {false, true}) {
    const test::TempFolder folder;
    VoxelAccumulator accumulator(VoxelGrid(1 << 20), {folder.path(), 1 << 20});
    for (int i = 0; i < 320; ++i)
      accumulator.add(batch, coloured ? std::span<const RawColour>(colours) : std::span<const RawColour>());
    const VoxelStore store = accumulator.finish();
    const std::uint32_t most = 16 * ((1U << 20) - 1);
    const Voxel expected{{-1, 0, 0}, {most, most, 112}, coloured ? RawColour{65535, 65534, 3} : RawColour{}};
    EXPECT_EQ(all_voxels(store), (std::vector<Voxel>{expected}));
    EXPECT_EQ(store.points(), std::uint64_t{320} << 16);
  }
}

TEST(VoxelAccumulator, NearlyFullSumsInManyRuns_AreMergedExactly) {
  // 60 runs, merged two by two, each with 3000 points of one voxel: two of them overflow 32 bits.
  const test::TempFolder folder;
  VoxelAccumulator accumulator(VoxelGrid(1 << 20), {folder.path(), 4096});
  std::vector<LatticePoint> points;
  for (std::int32_t round = 0; round < 60; ++round) {
    points.insert(points.end(), 3000, {kHalf - 1, kHalf - 2, 5});
    for (std::int32_t i = 1; i < 60; ++i) points.push_back({i << 20, 0, round});
  }
  const std::vector<RawColour> colours(points.size(), {65535, 1, 65535});
  accumulator.add(points, colours);
  EXPECT_EQ(all_voxels(accumulator.finish()), test::voxels_of(1 << 20, points, colours));
}

TEST(VoxelTotal, MorePointsThanInt32Holds_AreCounted) {
  VoxelTotal total({1, 2, 3});
  VoxelRecord record{{{1, 2, 3}, 4096, {4096U * 1048575U, 4096U * 3, 2048}}, {4096U * 65535U, 0, 2047}};
  const std::uint64_t count = std::uint64_t{1} << 21;  // 2^33 points.
  for (std::uint64_t i = 0; i < count; ++i) total.add(record);
  const Voxel voxel = total.mean();
  EXPECT_EQ(total.points(), std::uint64_t{1} << 33);
  EXPECT_EQ(voxel.centroid, (std::array<std::uint32_t, 3>{16U * 1048575U, 48, 8}));
  EXPECT_EQ(voxel.colour, (RawColour{65535, 0, 0}));  // 2047 / 4096 is below a half.
}

TEST(VoxelTable, ItsSums_FitItsBytes) {
  constexpr std::size_t kBytes = 100'000, kRoom = kBytes / (sizeof(VoxelSums) + kOrderBytes);
  std::vector<LatticePoint> points;
  for (std::int32_t i = 0; i < 10'000; ++i) points.push_back({i, -i, 5});
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    VoxelTable table(VoxelGrid(1), kBytes);
    EXPECT_TRUE(table.add(std::span(points).first(100), {}));
    EXPECT_FALSE(table.add(points, {}));
    std::size_t sums = 0, rounds = 1;
    for (bool all = false; !all; ++rounds) {
      const std::size_t size = table.sorted().size();
      EXPECT_LE(size, kRoom);
      EXPECT_GT(size, kRoom * 3 / 4) << "lanes get about as much each";
      if (threads == 1) {
        EXPECT_EQ(size, kRoom);
      }
      sums += size;
      table.clear();
      EXPECT_TRUE(table.empty());
      all = table.add(points, {});
    }
    EXPECT_EQ(sums + table.sorted().size(), points.size()) << "no point is added twice";
    EXPECT_EQ(rounds, points.size() / kRoom + 1);
  }
}

TEST(VoxelTable, KnownVoxels_NeedNoRoom) {
  const ThreadLimit limit(2);
  VoxelTable table(VoxelGrid(1), 100'000);
  std::vector<LatticePoint> points(50'000, {3, 4, 5});
  EXPECT_TRUE(table.add(points, {}));
  const VoxelTable::Sorted sums = table.sorted();
  ASSERT_EQ(sums.size(), 1U);
  EXPECT_EQ(sums[0].sums.points, points.size());
}

TEST(VoxelAccumulator, DiskFullAtAnyPoint_IsAnIoErrorWithTheReasonAndLeavesNoFiles) {
  const auto points = test::random_cloud(4, 60'000);
  for (const rlim_t size_bytes : {rlim_t{0}, rlim_t{4096}, rlim_t{100'000}, rlim_t{300'000}}) {
    const test::TempFolder folder;
    auto* const old_action = std::signal(SIGXFSZ, SIG_IGN);
    rlimit old_limit{};
    getrlimit(RLIMIT_FSIZE, &old_limit);
    rlimit limit = old_limit;
    limit.rlim_cur = size_bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
    std::string message;
    try {
      VoxelAccumulator accumulator(VoxelGrid(1), {folder.path(), 1 << 20});
      accumulator.add(points);
      accumulator.finish();
    } catch (const IoError& error) {
      message = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &old_limit);
    std::signal(SIGXFSZ, old_action);
    EXPECT_NE(message.find("voxels"), std::string::npos) << size_bytes << ": " << message;
    EXPECT_NE(message.find("free there"), std::string::npos) << message;
    EXPECT_EQ(files_in(folder.path()), 0U);
  }
}

TEST(VoxelAccumulator, AnyFlippedBitOfARun_IsAnIoError) {
  const auto points = test::random_cloud(5, 3000);
  for (const std::size_t place : {0U, 17U, 555U}) {
    const test::TempFolder folder;
    VoxelAccumulator accumulator(VoxelGrid(1), {folder.path(), 30'000});
    accumulator.add(points);
    const auto run = folder / "voxels-0.run";
    ASSERT_TRUE(std::filesystem::exists(run));
    test::flip_bit(run, place, 3);
    EXPECT_THROW(accumulator.finish(), IoError);
  }
  const test::TempFolder folder;
  VoxelAccumulator accumulator(VoxelGrid(1), {folder.path(), 30'000});
  accumulator.add(points);
  std::filesystem::resize_file(folder / "voxels-0.run", 100);
  EXPECT_THROW(accumulator.finish(), IoError);
}

}  // namespace
}  // namespace arris::tiling
