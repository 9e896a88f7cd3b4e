#include "tiling/plan_cells.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>

#include "tiling/random_cloud.h"
#include "tiling/survey_of.h"
#include "tiling/tile_plan.h"

namespace arris::tiling {
namespace {

using test::survey_of;

std::function<void(const PlanCells::Add&)> pass_over(const std::vector<LatticePoint>& points) {
  return [&points](const PlanCells::Add& add) { add(points, 1); };
}

RC_GTEST_PROP(PlanCells, AnyCloudRefined_EveryPointIsCountedInOneCellAndNoneIsCrowdedThatCouldBeCut, ()) {
  const auto points = test::any_cloud(1, 500);
  const Survey survey = survey_of(points, *rc::gen::inRange<std::size_t>(1, 50).as("max leaves"));
  const auto most = *rc::gen::inRange<std::uint64_t>(1, 100).as("most points");
  PlanCells cells(survey, most);
  while (cells.refine(pass_over(points))) {
  }
  std::size_t counted = 0;
  cells.for_each([&](const LatticeBox& box, int level, std::uint64_t count) {
    RC_ASSERT(box.max[0] - box.min[0] == std::int64_t{1} << level);
    RC_ASSERT(static_cast<std::uint64_t>(
                  std::ranges::count_if(points, [&](const LatticePoint& p) { return box.contains(p); })) == count);
    RC_ASSERT(count <= most || level == 0);
    counted += count;
  });
  RC_ASSERT(counted == points.size());
}

RC_GTEST_PROP(PlanCells, TilesOfRefinedCells_OwnEveryPointOnceAndFitIfTheyCan, ()) {
  const auto points = test::any_cloud(1, 500);
  const Survey survey = survey_of(points, *rc::gen::inRange<std::size_t>(1, 50).as("max leaves"));
  PlanRequest request;
  request.max_points = *rc::gen::inRange<std::uint64_t>(1, 200).as("max points");
  request.halo = [](double spacing) { return 0.5 * spacing; };
  request.max_radius = 1e9;
  PlanCells cells(survey, 1);
  while (cells.refine(pass_over(points))) {
  }
  std::map<LatticePoint, int> owners;
  for (const LatticePoint& p : points) owners[p] = 0;
  for (const PlannedTile& tile : plan_tiles(cells, request).tiles) {
    std::uint64_t core = 0;
    for (const LatticePoint& p : points) core += tile.core.contains(p) ? 1 : 0;
    RC_ASSERT(tile.core_points == core);
    for (auto& [p, count] : owners) count += tile.core.contains(p) ? 1 : 0;
  }
  for (const auto& [p, count] : owners) RC_ASSERT(count == 1);
}

TEST(PlanCells, CrowdInACornerOfAWideScan_IsCutIntoTiles) {
  std::vector<LatticePoint> points;
  for (std::int32_t i = 0; i < 4000; ++i) points.push_back({i * 100'000, i % 63 * 6'000'000, 0});
  for (std::int32_t i = 0; i < 40'000; ++i) points.push_back({i % 200, i / 200, 0});
  const Survey survey = survey_of(points, 64);
  PlanRequest request;
  request.max_points = 5000;
  request.halo = [](double) { return 3.0; };
  request.max_radius = 1e9;
  PlanCells cells(survey, request.max_points / 64);
  EXPECT_GT(plan_tiles(cells, request).largest_covered_points, 40'000U);
  int passes = 0;
  while (plan_tiles(cells, request).largest_covered_points > request.max_points && cells.refine(pass_over(points)))
    ++passes;
  EXPECT_LE(plan_tiles(cells, request).largest_covered_points, request.max_points);
  EXPECT_EQ(passes, 1);
}

TEST(PlanCells, SolidCloud_IsPlannedWithFewerCells) {
  std::vector<LatticePoint> points;
  for (std::int32_t x = 0; x < 128; ++x) {
    for (std::int32_t y = 0; y < 128; ++y) {
      for (std::int32_t z = 0; z < 128; ++z) points.push_back({x, y, z});
    }
  }
  const Survey survey = survey_of(points);
  ASSERT_GT(survey.counts.active_cells(), std::size_t{1} << 20);
  EXPECT_LE(PlanCells(survey).largest().active_cells(), std::size_t{1} << 20);
  EXPECT_EQ(PlanCells(survey).largest().total(), points.size());
}

}  // namespace
}  // namespace arris::tiling
