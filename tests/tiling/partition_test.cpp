#include "tiling/partition.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <map>
#include <random>
#include <set>

#include "core/error.h"
#include "support/temp_folder.h"
#include "tiling/random_cloud.h"
#include "tiling/spool.h"
#include "tiling/tile_router.h"

namespace arris::tiling {
namespace {

using Record = std::pair<LatticePoint, std::uint64_t>;

std::multiset<Record> spool_of(const std::filesystem::path& folder, std::size_t tile) {
  LatticePoints positions;
  PointIds ids;
  read_spool(spool_path(folder, tile), positions, ids);
  std::multiset<Record> records;
  for (std::size_t i = 0; i < positions.size(); ++i) records.emplace(positions[i], ids[i]);
  return records;
}

std::multiset<Record> inside(const std::vector<LatticePoint>& points, const LatticeBox& box) {
  std::multiset<Record> records;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (box.contains(points[i])) records.emplace(points[i], i);
  }
  return records;
}

CellCounts counts_of(const std::vector<LatticePoint>& points, std::size_t max_leaves) {
  CellCounts counts(0, max_leaves);
  counts.add(points);
  return counts;
}

/// Any boxes will do as tiles: they overlap, nest, and touch at points.
TilePlan random_plan(const std::vector<LatticePoint>& points, std::size_t tiles, std::mt19937_64& random) {
  TilePlan plan;
  for (std::size_t i = 0; i < tiles; ++i) {
    PlannedTile tile;
    tile.core.include(points[random() % points.size()]);
    if (random() % 4 != 0) tile.core.include(points[random() % points.size()]);
    tile.covered = tile.core.expanded(static_cast<std::int64_t>(1 + random() % 1000));
    plan.tiles.push_back(tile);
  }
  return plan;
}

RC_GTEST_PROP(Partitioner, AnyCloudAndTiles_SpoolsHoldExactlyTheCoveredPointsWhenClosed, ()) {
  const auto points = test::any_cloud(1, 400);
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>().as("plan seed"));
  const TilePlan plan = random_plan(points, 1 + random() % 40, random);
  const CellCounts counts = counts_of(points, 1 + random() % 100);
  const test::TempFolder folder;
  PartitionOptions options{folder.path(), *rc::gen::element<std::size_t>(1, 20, 100, 5000, 1 << 20).as("buffer bytes")};

  std::map<std::size_t, int> closed;
  Partitioner partitioner(counts, plan, options, [&](std::size_t tile) {
    ++closed[tile];
    RC_ASSERT(spool_of(folder.path(), tile) == inside(points, plan.tiles[tile].covered));
  });
  const auto batch = *rc::gen::inRange<std::size_t>(1, 100).as("batch");
  const auto batch_at = [&](std::size_t i) { return std::span(points).subspan(i, std::min(batch, points.size() - i)); };
  // Batches are counted so far ahead of those that are spooled.
  const std::size_t ahead = batch * *rc::gen::inRange<std::size_t>(0, 4).as("batches counted ahead");
  std::vector<std::vector<std::uint32_t>> complete(points.size());
  for (std::size_t i = 0; i < points.size() + ahead; i += batch) {
    if (i < points.size()) partitioner.count(batch_at(i), i, complete[i]);
    if (i < ahead) continue;
    partitioner.spool(batch_at(i - ahead), i - ahead);
    partitioner.close(complete[i - ahead]);
  }
  const PartitionResult result = partitioner.finish();
  std::uint64_t expected = 0, bytes = 0;
  for (std::size_t tile = 0; tile < plan.tiles.size(); ++tile) {
    RC_ASSERT(closed[tile] == 1);
    const auto records = inside(points, plan.tiles[tile].covered);
    expected += records.size();
    RC_ASSERT(spool_of(folder.path(), tile) == records);
    bytes += std::filesystem::file_size(spool_path(folder.path(), tile));
  }
  RC_ASSERT(result.spooled_points == expected);
  RC_ASSERT(result.spooled_bytes == bytes);
}

RC_GTEST_PROP(TileRouter, AnyPoint_ReachesTheTilesOfABruteForceSearchInAllItsRegion, ()) {
  const auto points = test::any_cloud(1, 200);
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>().as("plan seed"));
  const TilePlan plan = random_plan(points, 1 + random() % 30, random);
  TileRouter router(plan);
  const auto expected = [&](const LatticePoint& p) {
    std::vector<std::uint32_t> tiles;
    for (std::uint32_t tile = 0; tile < plan.tiles.size(); ++tile) {
      if (plan.tiles[tile].covered.contains(p)) tiles.push_back(tile);
    }
    return tiles;
  };
  for (const LatticePoint& p : points) {
    const TileRouter::Route& route = router.route(p);
    RC_ASSERT(route.region.contains(p));
    RC_ASSERT(route.tiles == expected(p));
    // The corners of the region are where a wrong cut would show.
    for (int corner = 0; corner < 8; ++corner) {
      LatticePoint q{test::clamp_to_int32(corner & 1 ? route.region.max[0] - 1 : route.region.min[0]),
                     test::clamp_to_int32(corner & 2 ? route.region.max[1] - 1 : route.region.min[1]),
                     test::clamp_to_int32(corner & 4 ? route.region.max[2] - 1 : route.region.min[2])};
      RC_ASSERT(route.tiles == expected(q));
    }
  }
}

TEST(Partitioner, CoherentInput_ClosesTilesBeforeTheEnd) {
  const auto points = test::plane_grid(200, 10);  // Ordered by x.
  Survey survey;
  survey.add(points, std::vector<Mapped>(points.size(), Mapped::kOk));
  survey.finish();
  PlanRequest request;
  request.max_points = 3000;
  request.halo = [](double spacing) { return 2.0 * spacing; };
  request.max_radius = 1e9;
  const TilePlan plan = plan_tiles(survey, request);
  ASSERT_GT(plan.tiles.size(), 8U);
  const test::TempFolder folder;
  std::size_t closed = 0, closed_at_half = 0;
  Partitioner partitioner(survey.counts, plan, {folder.path(), 1 << 16}, [&](std::size_t) { ++closed; });
  for (std::size_t i = 0; i < points.size(); i += 1000) {
    partitioner.add(std::span(points).subspan(i, 1000), i);
    if (i == points.size() / 2) closed_at_half = closed;
  }
  partitioner.finish();
  EXPECT_EQ(closed, plan.tiles.size());
  EXPECT_GE(closed_at_half * 4, plan.tiles.size());
}

TEST(Partitioner, MoreTilesThanOpenFilesAndBlocks_LosesNothing) {
  const auto points = test::random_cloud(5, 400);
  std::mt19937_64 random(11);
  const TilePlan plan = random_plan(points, 800, random);
  const CellCounts counts = counts_of(points, 50);
  const test::TempFolder folder;
  Partitioner partitioner(counts, plan, {folder.path(), 64 * 1024}, [](std::size_t) {});
  partitioner.add(points, 0);
  partitioner.finish();
  for (std::size_t tile = 0; tile < plan.tiles.size(); tile += 37) {
    EXPECT_EQ(spool_of(folder.path(), tile), inside(points, plan.tiles[tile].covered));
  }
}

TEST(Partitioner, PointsThatTheSurveyDidNotCount_AreAnInputError) {
  const std::vector<LatticePoint> points{{0, 0, 0}, {50, 0, 0}};
  std::mt19937_64 random(1);
  const TilePlan plan = random_plan(points, 1, random);
  const test::TempFolder folder;
  Partitioner partitioner(counts_of(points, 100), plan, {folder.path(), 1000}, [](std::size_t) {});
  const std::vector<LatticePoint> changed{{0, 0, 0}, {0, 0, 0}};
  EXPECT_THROW(partitioner.add(changed, 0), InputError);
}

TEST(Partitioner, MissingPoints_AreAnInputError) {
  const std::vector<LatticePoint> points{{0, 0, 0}, {50, 0, 0}};
  std::mt19937_64 random(1);
  const TilePlan plan = random_plan(points, 1, random);
  const test::TempFolder folder;
  Partitioner partitioner(counts_of(points, 100), plan, {folder.path(), 1000}, [](std::size_t) {});
  partitioner.add(std::span(points).first(1), 0);
  EXPECT_THROW(partitioner.finish(), InputError);
}

TEST(Partitioner, MissingFolder_IsAnIoErrorThatNamesTheFile) {
  const std::vector<LatticePoint> points(3000, LatticePoint{1, 2, 3});
  std::mt19937_64 random(1);
  const TilePlan plan = random_plan(points, 1, random);
  const test::TempFolder folder;
  Partitioner partitioner(counts_of(points, 100), plan, {folder / "absent", 1000}, [](std::size_t) {});
  try {
    partitioner.add(points, 0);
    FAIL() << "expected an IoError";
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("0.spool"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos);
  }
}

/// Caps the size of files this process may write, as a full disk would.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t size_bytes) {
    old_action_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &old_limit_);
    rlimit limit = old_limit_;
    limit.rlim_cur = size_bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_action_);
  }

 private:
  rlimit old_limit_{};
  void (*old_action_)(int) = nullptr;
};

TEST(Partitioner, FullDisk_IsAnIoErrorThatTellsTheSpace) {
  const std::vector<LatticePoint> points(5000, LatticePoint{1, 2, 3});
  std::mt19937_64 random(1);
  TilePlan plan = random_plan(points, 1, random);
  plan.tiles[0].covered_points = 5000;
  const test::TempFolder folder;
  Partitioner partitioner(counts_of(points, 100), plan, {folder.path(), 1000}, [](std::size_t) {});
  const FileSizeLimit limit(10'000);
  try {
    partitioner.add(points, 0);
    FAIL() << "expected an IoError";
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("free there"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("more needed"), std::string::npos) << error.what();
  }
}

TEST(Spool, FileOfAnyOtherLength_IsRefused) {
  const test::TempFolder folder;
  {
    SpoolWriter writer(folder.path(), 1, {});
    const std::vector<LatticePoint> points{{1, 2, 3}, {4, 5, 6}};
    writer.append(0, points, 7);
    writer.close(0);
  }
  EXPECT_EQ(spool_of(folder.path(), 0), (std::multiset<Record>{{{1, 2, 3}, 7}, {{4, 5, 6}, 8}}));
  const auto size = std::filesystem::file_size(spool_path(folder.path(), 0));
  for (std::uintmax_t length = 2 * size; length-- > 0;) {
    if (length == size) continue;
    std::filesystem::resize_file(spool_path(folder.path(), 0), length);
    EXPECT_THROW(spool_of(folder.path(), 0), IoError) << length;
  }
}

TEST(Spool, StaleFile_IsReplaced) {
  const test::TempFolder folder;
  for (const std::uint64_t first : {std::uint64_t{10}, std::uint64_t{20}}) {
    SpoolWriter writer(folder.path(), 1, {});
    const std::vector<LatticePoint> points{{1, 2, 3}};
    writer.append(0, points, first);
    writer.close(0);
  }
  EXPECT_EQ(spool_of(folder.path(), 0), (std::multiset<Record>{{{1, 2, 3}, 20}}));
}

}  // namespace
}  // namespace arris::tiling
