#include "tiling/tile_store.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <bit>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <sstream>

#include "core/error.h"
#include "support/las_tools.h"
#include "support/temp_folder.h"
#include "tiling/manifest.h"
#include "tiling/morton.h"
#include "tiling/point_grid.h"
#include "tiling/random_cloud.h"
#include "tiling/spool.h"

namespace arris::tiling {
namespace {

using Record = std::pair<LatticePoint, std::uint64_t>;

constexpr LatticeBox kEverything{{-(std::int64_t{1} << 31), -(std::int64_t{1} << 31), -(std::int64_t{1} << 31)},
                                 {std::int64_t{1} << 31, std::int64_t{1} << 31, std::int64_t{1} << 31}};

TilePlan one_tile_plan(const LatticeBox& core = kEverything) {
  TilePlan plan;
  plan.tiles.push_back({core, core.expanded(5), 0, 0});
  return plan;
}

/// A store of one tile with the given points, ids 0, 1, ... , spooled and ready to build.
struct OneTile {
  explicit OneTile(const std::vector<LatticePoint>& points, const LatticeBox& core = kEverything)
      : store(folder.path(), Lattice{0.001, {1, 2, 3}}, one_tile_plan(core), "hash") {
    SpoolWriter writer(folder.path(), 1, {});
    writer.append(0, points, 0);
    writer.close(0);
  }
  std::filesystem::path file() const { return folder.path() / "0.vdb"; }

  test::TempFolder folder;
  TileStore store;
};

std::multiset<Record> all_records(const TilePoints& tile) {
  std::multiset<Record> records;
  for (std::size_t i = 0; i < tile.positions.size(); ++i) records.emplace(tile.positions[i], tile.ids[i]);
  for (const auto& [id, index] : tile.duplicates) records.emplace(tile.positions[index], id);
  return records;
}

std::multiset<Record> numbered(const std::vector<LatticePoint>& points) {
  std::multiset<Record> records;
  for (std::size_t i = 0; i < points.size(); ++i) records.emplace(points[i], i);
  return records;
}

RC_GTEST_PROP(TileStore, AnyCloud_ComesBackWithoutLossFoldedInZOrder, ()) {
  const auto points = test::any_cloud(1, 3000);
  OneTile tile(points);
  tile.store.build(0);
  const TilePoints loaded = tile.store.load(0);
  RC_ASSERT(all_records(loaded) == numbered(points));
  RC_ASSERT(tile.store.points(0) == points.size());
  RC_ASSERT(std::ranges::adjacent_find(loaded.positions, [](const auto& a, const auto& b) {
              return !z_order_less(a, b);
            }) == loaded.positions.end());
  for (const auto& [id, index] : loaded.duplicates) RC_ASSERT(id > loaded.ids[index]);
  RC_ASSERT(!std::filesystem::exists(spool_path(tile.folder.path(), 0)));

  TilePoints folded;
  LatticePoints copy(points.begin(), points.end());
  PointIds ids(points.size());
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = i;
  fold_duplicates(std::move(copy), std::move(ids), folded);
  RC_ASSERT(folded.positions == loaded.positions);
  RC_ASSERT(folded.ids == loaded.ids);
}

/// `count` points spread so that leaves of 2^(v + 3) steps are just the right size.
class EveryStorageVoxel : public testing::TestWithParam<int> {};

TEST_P(EveryStorageVoxel, EveryStepOfAVoxel_IsStoredExactly) {
  // 1500 points per leaf side of 2^(v + 3) steps, around a corner where eight leaves meet at negative and positive
  // coordinates.
  const int log2 = GetParam();
  const std::int64_t leaf = std::int64_t{8} << log2;
  std::mt19937_64 random(3);
  std::vector<LatticePoint> points;
  for (int i = 0; i < 12'000; ++i) {
    const auto coordinate = [&] {
      // Borders of voxels as often as anything else.
      std::int64_t v = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(2 * leaf)) - leaf;
      if (random() % 2) v = (v >> log2 << log2) - static_cast<std::int64_t>(random() % 2);
      return test::clamp_to_int32(v);
    };
    points.push_back({coordinate(), coordinate(), coordinate()});
  }
  std::vector<std::uint64_t> ids(points.size());
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = i;
  std::stringstream stream;
  PointGrid(points, ids, {}).write(stream);
  const SortedPoints back = read_point_grid(stream);
  std::multiset<Record> records;
  for (std::size_t i = 0; i < back.positions.size(); ++i) records.emplace(back.positions[i], back.ids[i]);
  EXPECT_EQ(records, numbered(points));
}
INSTANTIATE_TEST_SUITE_P(Log2, EveryStorageVoxel, testing::Range(0, 19));

TEST(PointGrid, AllStepsOfTheLargestFixedPointVoxel_AreTold) {
  // Steps 0 .. 8191 of voxels of 2^13, on each axis, with enough points for leaves of 2^16 steps.
  std::vector<LatticePoint> points;
  for (std::int32_t i = -8192; i < 8192; ++i) points.push_back({i * 8, -i * 8 - 5, i});
  for (std::int32_t i = -65536; i < 65536; i += 7) points.push_back({i, -i, i / 2});
  std::vector<std::uint64_t> ids(points.size(), 0);
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = (std::uint64_t{1} << 62) + i;
  std::stringstream stream;
  PointGrid(points, ids, {}).write(stream);
  const SortedPoints back = read_point_grid(stream);
  std::set<Record> expected, found;
  for (std::size_t i = 0; i < points.size(); ++i) expected.emplace(points[i], ids[i]);
  for (std::size_t i = 0; i < back.positions.size(); ++i) found.emplace(back.positions[i], back.ids[i]);
  EXPECT_EQ(found, expected);
}

TEST(PointGrid, LonePointsAllOverTheLattice_TakeLittleAndComeBackInZOrder) {
  std::mt19937 random(5);
  std::vector<LatticePoint> points;
  std::vector<std::uint64_t> ids;
  const auto coordinate = [&] { return static_cast<std::int32_t>(random()); };
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    points.push_back({coordinate(), coordinate(), coordinate()});
    ids.push_back(i);
  }
  std::stringstream stream;
  PointGrid(points, ids, {}).write(stream);
  EXPECT_LT(stream.str().size(), 24 * points.size());
  const SortedPoints back = read_point_grid(stream);
  EXPECT_TRUE(std::ranges::is_sorted(back.positions, z_order_less));
  std::multiset<Record> records;
  for (std::size_t i = 0; i < back.positions.size(); ++i) records.emplace(back.positions[i], back.ids[i]);
  EXPECT_EQ(records, numbered(points));

  const LatticeBox low{{-(std::int64_t{1} << 31), -(std::int64_t{1} << 31), -(std::int64_t{1} << 31)}, {0, 0, 0}};
  stream.clear();
  stream.seekg(0);
  const SortedPoints near = read_point_grid(stream, [&](const LatticeBox& box) { return box.intersects(low); });
  const auto inside = [&](const SortedPoints& all) {
    return std::ranges::count_if(all.positions, [&](const LatticePoint& p) { return low.contains(p); });
  };
  EXPECT_LT(near.positions.size(), points.size());
  EXPECT_EQ(near.positions.size(), near.ids.size());
  EXPECT_EQ(inside(near), inside(back));
}

TEST(TileStore, OnePoint_ComesBack) {
  OneTile tile({{-7, 8, -9}});
  tile.store.build(0);
  const TilePoints loaded = tile.store.load(0);
  EXPECT_EQ(loaded.positions, (LatticePoints{{-7, 8, -9}}));
  EXPECT_EQ(loaded.ids, (PointIds{0}));
  EXPECT_EQ(loaded.core, kEverything);
  EXPECT_EQ(loaded.covered, kEverything.expanded(5));
}

TEST(TileStore, NoPoints_ComesBackEmpty) {
  OneTile tile({});
  tile.store.build(0);
  EXPECT_TRUE(tile.store.load(0).positions.empty());
}

TEST(TileStore, AllPointsEqual_FoldIntoOneWithTheSmallestId) {
  OneTile tile(std::vector<LatticePoint>(20'000, LatticePoint{1, -2, 3}));
  tile.store.build(0);
  const TilePoints loaded = tile.store.load(0);
  ASSERT_EQ(loaded.positions.size(), 1U);
  EXPECT_EQ(loaded.ids[0], 0U);
  EXPECT_EQ(loaded.duplicates.size(), 19'999U);
}

TEST(TileStore, LoadCore_GivesOwnedAndKeptPointsOnly) {
  const LatticeBox core{{0, 0, 0}, {10, 10, 10}};
  OneTile tile({{0, 0, 0}, {9, 9, 9}, {10, 0, 0}, {-1, 0, 0}, {5, 5, 5}, {5, 5, 5}}, core);
  tile.store.build(0);
  const SortedPoints points = tile.store.load_core(0, [](const LatticePoint& p) { return p.x > 0; });
  EXPECT_EQ(points.positions, (LatticePoints{{5, 5, 5}, {5, 5, 5}, {9, 9, 9}}));
  EXPECT_EQ(points.ids, (PointIds{4, 5, 1}));
}

TEST(TileStore, LoadCore_OfLeavesNearby_MissesNothingThatIsNear) {
  OneTile tile(test::random_cloud(9, 20'000));
  tile.store.build(0);
  const SortedPoints all = tile.store.load_core(0, [](const LatticePoint&) { return true; });
  LatticeBox near;
  for (std::size_t i = 0; i < 20; ++i) near.include(all.positions[i]);
  const auto touches = [&](const LatticeBox& box) { return box.intersects(near); };
  const auto inside = [&](const LatticePoint& p) { return near.contains(p); };
  const SortedPoints whole = tile.store.load_core(0, inside);
  const SortedPoints part = tile.store.load_core(0, inside, touches);
  ASSERT_GE(whole.ids.size(), 20U);
  EXPECT_EQ(part.positions, whole.positions);
  EXPECT_EQ(part.ids, whole.ids);
  EXPECT_LT(tile.store
                .load_core(
                    0, [](const LatticePoint&) { return true; }, touches)
                .ids.size(),
            all.ids.size());
}

TEST(TileStore, EveryBitFlip_IsDetected) {
  OneTile tile(test::random_cloud(9, 2000));
  tile.store.build(0);
  const std::string intact = test::file_bytes(tile.file());
  std::mt19937_64 random(4);
  for (int i = 0; i < 200; ++i) {
    std::string damaged = intact;
    const std::size_t bit = random() % (damaged.size() * 8);
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    test::write_bytes(tile.file(), damaged);
    EXPECT_THROW(tile.store.load(0), IoError) << "bit " << bit;
  }
  test::write_bytes(tile.file(), intact);
  EXPECT_EQ(tile.store.load(0).positions.size() + tile.store.load(0).duplicates.size(), 2000U);
}

TEST(TileStore, FileOfAnotherLength_IsDetected) {
  OneTile tile(test::random_cloud(9, 2000));
  tile.store.build(0);
  const std::string intact = test::file_bytes(tile.file());
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, intact.size() / 2, intact.size() - 1}) {
    test::write_bytes(tile.file(), intact.substr(0, size));
    EXPECT_THROW(tile.store.load(0), IoError) << size;
  }
  test::write_bytes(tile.file(), intact + "x");
  EXPECT_THROW(tile.store.load(0), IoError);
  std::filesystem::remove(tile.file());
  EXPECT_THROW(tile.store.load(0), IoError);
}

TEST(TileStore, WriteFailure_IsAnIoErrorAndLeavesNoFile) {
  const auto points = test::random_cloud(9, 20'000);
  OneTile tile(points);
  // Failing at the first block, in the middle, and in the last flush.
  for (const rlim_t size_bytes : {rlim_t{0}, rlim_t{4096}, rlim_t{100'000}, rlim_t{270'000}}) {
    auto* const old_action = std::signal(SIGXFSZ, SIG_IGN);
    rlimit old_limit{};
    getrlimit(RLIMIT_FSIZE, &old_limit);
    rlimit limit = old_limit;
    limit.rlim_cur = size_bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
    std::string message;
    try {
      tile.store.build(0);
    } catch (const IoError& error) {
      message = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &old_limit);
    std::signal(SIGXFSZ, old_action);
    EXPECT_NE(message.find("0.vdb"), std::string::npos) << size_bytes << ": " << message;
    EXPECT_NE(message.find("free there"), std::string::npos) << message;
    EXPECT_FALSE(std::filesystem::exists(tile.file()));
    EXPECT_FALSE(std::filesystem::exists(tile.file().string() + ".partial"));
    EXPECT_EQ(tile.store.points(0), 0U);
  }
  tile.store.build(0);  // The spool is still there.
  EXPECT_EQ(all_records(tile.store.load(0)), numbered(points));
}

TEST(TileStore, BuiltAndRemovedTiles_AreAccountedFor) {
  OneTile tile(test::random_cloud(9, 2000));
  EXPECT_EQ(tile.store.bytes_on_disk(), 0U);
  EXPECT_THROW(tile.store.load(0), IoError);
  tile.store.build(0);
  EXPECT_EQ(tile.store.bytes_on_disk(), std::filesystem::file_size(tile.file()));
  tile.store.remove(0);
  EXPECT_EQ(tile.store.bytes_on_disk(), 0U);
  EXPECT_FALSE(std::filesystem::exists(tile.file()));
}

TEST(Manifest, Lines_AreReadBackUntilTheFirstDamagedOne) {
  const test::TempFolder folder;
  const Lattice lattice{0.001, {1, 2, 3}};
  const ManifestEntry first{0, 10, 100, 0xffffffffffffffffULL}, second{2, 20, 200, 7};
  {
    Manifest manifest(folder.path(), lattice, 3, "abc");
    manifest.append(first, {});
    manifest.append(second, {});
  }
  const auto entries = read_manifest(folder.path(), lattice, 3, "abc");
  ASSERT_TRUE(entries);
  EXPECT_EQ(*entries, (std::map<std::size_t, ManifestEntry>{{0, first}, {2, second}}));
  EXPECT_FALSE(read_manifest(folder.path(), lattice, 3, "abd"));
  EXPECT_FALSE(read_manifest(folder.path(), Lattice{0.001, {1, 2, 4}}, 3, "abc"));
  EXPECT_FALSE(read_manifest(folder / "absent", lattice, 3, "abc"));

  std::string bytes = test::file_bytes(folder / "manifest.jsonl");
  test::write_bytes(folder / "manifest.jsonl", bytes.substr(0, bytes.size() - 5));  // Torn.
  EXPECT_EQ(*read_manifest(folder.path(), lattice, 3, "abc"), (std::map<std::size_t, ManifestEntry>{{0, first}}));
  bytes[2] = static_cast<char>(bytes[2] ^ 1);
  test::write_bytes(folder / "manifest.jsonl", bytes);
  EXPECT_FALSE(read_manifest(folder.path(), lattice, 3, "abc"));
}

RC_GTEST_PROP(ZOrder, Comparison_AgreesWithInterleavedBits,
              (std::int32_t x, std::int32_t y, std::int32_t z, std::int32_t u)) {
  const LatticePoint a{x >> 11, y >> 11, z >> 11}, b{u >> 11, y >> 11, x >> 12};  // 21 bits, so that keys exist.
  const auto key = [](const LatticePoint& p) {
    const auto flip = [](std::int32_t v) { return static_cast<std::uint32_t>(v + (1 << 20)); };
    return z_key(flip(p.x), flip(p.y), flip(p.z));
  };
  RC_ASSERT(z_order_less(a, b) == (key(a) < key(b)));
  RC_ASSERT(z_order_less(b, a) == (key(b) < key(a)));
  std::uint64_t spread = 0;
  for (int bit = 0; bit < 21; ++bit) spread |= std::uint64_t{static_cast<std::uint32_t>(x) >> bit & 1U} << 3 * bit;
  RC_ASSERT(spread_bits(static_cast<std::uint32_t>(x)) == spread);
}

}  // namespace
}  // namespace arris::tiling
