#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <random>
#include <span>

#include "core/error.h"
#include "core/parallel.h"
#include "support/las_tools.h"
#include "support/shared_data.h"
#include "support/temp_folder.h"
#include "tiling/partition.h"
#include "tiling/random_cloud.h"
#include "tiling/survey.h"
#include "tiling/tile_plan.h"
#include "tiling/tile_store.h"

namespace arris::tiling {
namespace {

class NoProgress : public ProgressSink {
 public:
  void phase(std::string_view, std::uint64_t) override {}
  void advance(std::uint64_t done_points) override { done += done_points; }
  void warning(std::string_view, std::string_view) override {}
  void note(std::string_view) override {}
  std::atomic<std::uint64_t> done = 0;
};

std::vector<std::array<std::int32_t, 3>> as_arrays(const std::vector<LatticePoint>& points) {
  std::vector<std::array<std::int32_t, 3>> arrays;
  for (const LatticePoint& p : points) arrays.push_back({p.x, p.y, p.z});
  return arrays;
}

PlanRequest request(std::uint64_t max_points) {
  PlanRequest request;
  request.max_points = max_points;
  request.halo = [](double spacing) { return 4.0 * spacing; };
  request.max_radius = 10.0;
  return request;
}

void expect_same(const Survey& a, const Survey& b) {
  EXPECT_EQ(a.lattice.step, b.lattice.step);
  EXPECT_EQ(a.lattice.origin, b.lattice.origin);
  EXPECT_EQ(a.bounds, b.bounds);
  EXPECT_EQ(a.points(), b.points());
  EXPECT_EQ(a.spacing, b.spacing);
  EXPECT_EQ(a.counts.level(), b.counts.level());
  EXPECT_EQ(a.counts.active_cells(), b.counts.active_cells());
}

TEST(SurveyInputs, OrderAndFileSplit_DoNotMatter) {
  const test::TempFolder folder;
  // So many that the level is looked for here and there in the files: in one case in a corner of the cloud first.
  auto points = test::random_cloud(21, 300'000);
  std::ranges::sort(points, {}, &LatticePoint::x);
  test::write_las(folder / "one.las", as_arrays(points));
  std::mt19937_64 random(1);
  std::ranges::shuffle(points, random);
  test::write_las(folder / "shuffled.las", as_arrays(points));
  NoProgress progress;
  const CancelToken cancel;
  io::InputSet one({folder / "one.las"}), many(test::split_las(folder / "shuffled.las", 5, folder.path()));
  const Survey a = survey_inputs(one, {}, progress, cancel);
  EXPECT_EQ(progress.done, 300'000U);
  EXPECT_EQ(a.points_in, 300'000U);
  EXPECT_EQ(a.lattice.step, 0.001);
  const Survey b = survey_inputs(many, {}, progress, cancel);
  expect_same(a, b);
  EXPECT_GT(a.counts.level(), 0);
  for (const LatticePoint& p : std::span(points).first(1000)) EXPECT_EQ(a.counts.count_at(p), b.counts.count_at(p));
}

TEST(SurveyInputs, Threads_DoNotMatter) {
  const test::TempFolder folder;
  // Several batches; the first is coarse enough for its part of the counts to end on another level than the others.
  auto points = test::random_cloud(22, 300'000);
  for (std::size_t i = 0; i < 65'536; ++i) points[i] = {points[i].x / 4096, points[i].y / 4096, points[i].z / 4096};
  test::write_las(folder / "cloud.las", as_arrays(points));
  io::InputSet inputs({folder / "cloud.las"});
  NoProgress progress;
  const CancelToken cancel;
  const auto survey_with = [&](int threads) {
    const ThreadLimit limit(threads);
    return survey_inputs(inputs, {}, progress, cancel);
  };
  const Survey alone = survey_with(1);
  EXPECT_EQ(progress.done, points.size());
  for (const int threads : {2, 4}) expect_same(alone, survey_with(threads));
  EXPECT_EQ(progress.done, 3 * points.size());
}

TEST(SurveyInputs, PlyWithHoles_CountsWhatTakesNoPart) {
  const test::TempFolder folder;
  {
    std::ofstream ply(folder / "a.ply");
    ply << "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\nproperty double "
           "z\nend_header\n"
           "1 2 3\nnan 0 0\n1.5 2.5 3.5\n0 0 inf\n1e13 0 0\n";
  }
  io::InputSet inputs({folder / "a.ply"});
  NoProgress progress;
  const Survey survey = survey_inputs(inputs, {}, progress, CancelToken{});
  EXPECT_EQ(survey.points_in, 5U);
  EXPECT_EQ(survey.dropped_nonfinite, 2U);
  EXPECT_EQ(survey.dropped_out_of_range, 1U);
  EXPECT_EQ(survey.points(), 2U);
  EXPECT_EQ(survey.bounds.max[0] - survey.bounds.min[0], 5001);
}

TEST(SurveyInputs, EmptyCloud_HasNoBoundsAndNoTiles) {
  const test::TempFolder folder;
  test::write_las(folder / "empty.las", {});
  io::InputSet inputs({folder / "empty.las"});
  NoProgress progress;
  const Survey survey = survey_inputs(inputs, {}, progress, CancelToken{});
  EXPECT_TRUE(survey.bounds.empty());
  EXPECT_EQ(survey.spacing, 0.0);
  EXPECT_TRUE(plan_tiles(survey, request(10)).tiles.empty());
}

TEST(SurveyInputs, Cancelled_Stops) {
  const test::TempFolder folder;
  test::write_las(folder / "a.las", {{1, 2, 3}});
  io::InputSet inputs({folder / "a.las"});
  NoProgress progress;
  CancelToken cancel;
  cancel.request();
  EXPECT_THROW(survey_inputs(inputs, {}, progress, cancel), Cancelled);
}

/// Survey, plan, partition, build and load of whole files: every point comes back from its owner with its id and
/// position.
void expect_round_trip(io::InputSet& inputs, std::uint64_t max_points) {
  NoProgress progress;
  const CancelToken cancel;
  const Survey survey = survey_inputs(inputs, {}, progress, cancel);
  const TilePlan plan = plan_tiles(survey, request(max_points));
  const test::TempFolder folder;
  TileStore store(folder.path(), survey.lattice, plan, "test");
  partition_points(
      inputs, survey, plan, {folder.path(), 1 << 20}, [&](std::size_t tile) { store.build(tile); }, progress, cancel);

  std::vector<LatticePoint> expected(inputs.points());
  const LatticeMapper mapper(inputs.sources(), survey.lattice);
  io::PointBatch batch;
  std::vector<LatticePoint> positions;
  std::vector<Mapped> outcome;
  inputs.rewind();
  while (inputs.read(batch, {})) {
    mapper.map(batch, inputs.source_index(), positions, outcome);
    std::ranges::copy(positions, expected.begin() + static_cast<std::ptrdiff_t>(batch.first_id));
  }
  std::vector<bool> seen(expected.size(), false);
  for (std::size_t tile = 0; tile < plan.tiles.size(); ++tile) {
    const auto [owned, ids] = store.load_core(tile, [](const LatticePoint&) { return true; });
    EXPECT_EQ(owned.size(), plan.tiles[tile].core_points);
    EXPECT_LE(store.points(tile), plan.tiles[tile].covered_points);
    for (std::size_t i = 0; i < owned.size(); ++i) {
      ASSERT_FALSE(seen[ids[i]]);
      seen[ids[i]] = true;
      ASSERT_EQ(owned[i], expected[ids[i]]);
    }
  }
  EXPECT_EQ(static_cast<std::uint64_t>(std::ranges::count(seen, true)), survey.points());
}

TEST(Tiling, SyntheticFiles_ComeBackTileByTile) {
  const test::TempFolder folder;
  test::write_las(folder / "a.las", as_arrays(test::random_cloud(31, 10'000)));
  test::write_las(folder / "b.las", as_arrays(test::plane_grid(100, 20)));
  io::InputSet inputs({folder / "a.las", folder / "b.las"});
  expect_round_trip(inputs, 2500);
}

TEST(Tiling, AirborneScan_ComesBackTileByTile) {
  ARRIS_SHARED_DATA_OR_SKIP(path, "IGNF+lidar-prod/tests/files/870000_6618000.subset.postValidation.las");
  io::InputSet inputs({path});
  expect_round_trip(inputs, 15'000);
}

TEST(Partition, FileReplacedAfterTheSurvey_IsAnInputError) {
  const test::TempFolder folder;
  auto points = test::plane_grid(50, 10);
  test::write_las(folder / "a.las", as_arrays(points));
  io::InputSet inputs({folder / "a.las"});
  NoProgress progress;
  const CancelToken cancel;
  const Survey survey = survey_inputs(inputs, {}, progress, cancel);
  const TilePlan plan = plan_tiles(survey, request(1000));
  points[1234].x += 5000;
  test::write_las(folder / "a.las", as_arrays(points));
  EXPECT_THROW(partition_points(
                   inputs, survey, plan, {folder.path(), 1 << 16}, [](std::size_t) {}, progress, cancel),
               InputError);
}

}  // namespace
}  // namespace arris::tiling
