#include "tiling/cell_counts.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "tiling/random_cloud.h"

namespace arris::tiling {
namespace {

using Cells = std::map<std::array<std::int64_t, 3>, std::uint64_t>;

std::array<std::int64_t, 3> cell_of(const LatticePoint& p, int level) {
  return {std::int64_t{p.x} >> level, std::int64_t{p.y} >> level, std::int64_t{p.z} >> level};
}

Cells brute_force(const std::vector<LatticePoint>& points, int level) {
  Cells cells;
  for (const LatticePoint& p : points) ++cells[cell_of(p, level)];
  return cells;
}

std::size_t leaves(const std::vector<LatticePoint>& points, int level) {
  std::set<std::array<std::int64_t, 3>> found;
  for (const LatticePoint& p : points) found.insert(cell_of(p, level + 3));
  return found.size();
}

Cells listed(const CellCounts& counts) {
  Cells cells;
  std::array<std::int64_t, 3> last{std::numeric_limits<std::int64_t>::min(), 0, 0};
  counts.for_each([&](const LatticeBox& box, std::uint64_t count) {
    EXPECT_LT(last, box.min) << "cells come in ascending order";
    last = box.min;
    std::array<std::int64_t, 3> cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(box.max[axis] - box.min[axis], std::int64_t{1} << counts.level());
      cell[axis] = box.min[axis] >> counts.level();
    }
    cells[cell] = count;
  });
  return cells;
}

/// Cells by their points.
std::map<std::uint64_t, std::uint64_t> classes_of(const Cells& cells) {
  std::map<std::uint64_t, std::uint64_t> classes;
  for (const auto& [cell, count] : cells) ++classes[count];
  return classes;
}

std::map<std::uint64_t, std::uint64_t> classes_of(const CellCounts& counts) {
  std::map<std::uint64_t, std::uint64_t> classes;
  std::uint64_t last = 0;
  for (const CellClass& of : counts.classes()) {
    EXPECT_LT(last, of.points) << "classes ascend, and no cell is empty";
    last = of.points;
    classes[of.points] = of.cells;
  }
  return classes;
}

RC_GTEST_PROP(CellCounts, AnyCloud_CountsAsBruteForceOnTheFinestLevelThatFits, ()) {
  const auto points = test::any_cloud(1, 600);
  const auto max_leaves = *rc::gen::inRange<std::size_t>(1, 100).as("max leaves");
  int level = 0;
  while (level < 30 && leaves(points, level) > max_leaves) ++level;
  CellCounts counts(0, max_leaves);
  const std::size_t half = points.size() / 2;
  counts.add(std::span(points).first(half));
  counts.add(std::span(points).subspan(half));
  RC_ASSERT(counts.level() == level);
  RC_ASSERT(counts.total() == points.size());
  const Cells expected = brute_force(points, level);
  RC_ASSERT(counts.active_cells() == expected.size());
  RC_ASSERT(listed(counts) == expected);
  RC_ASSERT(classes_of(counts) == classes_of(expected));
  RC_ASSERT(counts.count_at(points.front()) == expected.at(cell_of(points.front(), level)));
}

RC_GTEST_PROP(CellCounts, AnyOrder_GivesTheSameLevelAndCounts, ()) {
  auto points = test::any_cloud(1, 600);
  const auto max_leaves = *rc::gen::inRange<std::size_t>(1, 100).as("max leaves");
  CellCounts one(0, max_leaves), other(0, max_leaves);
  one.add(points);
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  std::ranges::shuffle(points, random);
  for (const LatticePoint& p : points) other.add(std::span(&p, 1));
  RC_ASSERT(one.level() == other.level());
  RC_ASSERT(listed(one) == listed(other));
}

RC_GTEST_PROP(CellCounts, ByLeaf_VisitsTheSameCellsInAnOrderOfTheSetOnly, ()) {
  auto points = test::any_cloud(1, 600);
  const auto max_leaves = *rc::gen::inRange<std::size_t>(1, 100).as("max leaves");
  const auto visited = [&] {
    CellCounts counts(0, max_leaves);
    counts.add(points);
    std::vector<std::pair<std::array<std::int64_t, 3>, std::uint64_t>> cells;
    counts.for_each_by_leaf([&](const LatticeBox& box, std::uint64_t count) { cells.emplace_back(box.min, count); });
    Cells sorted;
    counts.for_each([&](const LatticeBox& box, std::uint64_t count) { sorted[box.min] = count; });
    RC_ASSERT(cells.size() == sorted.size());
    RC_ASSERT(Cells(cells.begin(), cells.end()) == sorted);
    return cells;
  };
  const auto before = visited();
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  std::ranges::shuffle(points, random);
  RC_ASSERT(visited() == before);
}

RC_GTEST_PROP(CellCounts, Coarsened_IsTheExactUnionOfCells, ()) {
  const auto points = test::any_cloud(1, 300);
  CellCounts counts(*rc::gen::inRange(0, 12));
  counts.add(points);
  const int level = *rc::gen::inRange(counts.level(), 31);
  const CellCounts coarse = counts.coarsened(level);
  RC_ASSERT(coarse.level() == level);
  RC_ASSERT(coarse.total() == points.size());
  RC_ASSERT(listed(coarse) == brute_force(points, level));
  RC_ASSERT(listed(counts) == brute_force(points, counts.level()));
}

RC_GTEST_PROP(CellCounts, Remove_EmptiesEachCellOnceAtItsLastPoint, ()) {
  auto points = test::any_cloud(1, 300);
  CellCounts counts(4, 50);
  counts.add(points);
  const int level = counts.level();
  Cells expected = brute_force(points, level);
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  std::ranges::shuffle(points, random);
  for (const LatticePoint& p : points) {
    const bool last = --expected[cell_of(p, level)] == 0;
    std::size_t events = 0;
    const std::size_t missing = counts.remove(std::span(&p, 1), [&](const LatticeBox& cell) {
      ++events;
      RC_ASSERT(cell.contains(p));
    });
    RC_ASSERT(missing == 0U);
    RC_ASSERT(events == (last ? 1U : 0U));
  }
  RC_ASSERT(counts.total() == 0U);
  RC_ASSERT(counts.active_cells() == 0U);
}

/// What several threads found, at levels of several times, some of them finer than what is counted at by then.
RC_GTEST_PROP(CellCounts, RunsOfAnyLevelNotTooCoarse_CountAsTheirPoints, ()) {
  const auto points = test::any_cloud(1, 600);
  const auto max_leaves = *rc::gen::inRange<std::size_t>(1, 100).as("max leaves");
  CellCounts expected(0, max_leaves), counts(0, max_leaves);
  expected.add(points);
  CellRuns runs;
  for (std::size_t begin = 0; begin < points.size();) {
    const std::size_t count = *rc::gen::inRange<std::size_t>(1, points.size() - begin + 1);
    runs.clear(*rc::gen::inRange(0, expected.level() + 1));
    runs.add(std::span(points).subspan(begin, count));
    counts.add(runs);
    begin += count;
  }
  RC_ASSERT(counts.level() == expected.level());
  RC_ASSERT(counts.total() == points.size());
  RC_ASSERT(listed(counts) == listed(expected));
}

/// Leaves hold small counts only: the rest is kept elsewhere, and moves along.
RC_GTEST_PROP(CellCounts, CountsOfAnySize_AddCoarsenAndRemoveExactly, ()) {
  const auto cells = *rc::gen::inRange<std::int32_t>(1, 20);
  const auto many = rc::gen::oneOf(rc::gen::inRange<std::uint64_t>(1, 5), rc::gen::inRange<std::uint64_t>(32760, 32776),
                                   rc::gen::inRange<std::uint64_t>(65530, 131080));
  CellCounts counts(0);
  Cells expected;
  for (std::int32_t i = 0; i < cells; ++i) {
    const LatticePoint p{i % 3, i % 5, 0};
    const std::uint64_t count = *many;
    counts.add(p, count);
    expected[cell_of(p, 0)] += count;
  }
  RC_ASSERT(listed(counts) == expected);
  RC_ASSERT(classes_of(counts) == classes_of(expected));
  Cells coarse;
  for (const auto& [cell, count] : expected) coarse[{cell[0] >> 1, cell[1] >> 1, 0}] += count;
  RC_ASSERT(listed(counts.coarsened(1)) == coarse);
  for (auto& [cell, count] : expected) {
    const LatticePoint p{static_cast<std::int32_t>(cell[0]), static_cast<std::int32_t>(cell[1]), 0};
    const std::vector<LatticePoint> gone(*rc::gen::inRange<std::uint64_t>(1, count + 3), p);
    const std::uint64_t taken = std::min<std::uint64_t>(gone.size(), count);
    std::size_t emptied = 0;
    RC_ASSERT(counts.remove(gone, [&](const LatticeBox&) { ++emptied; }) == gone.size() - taken);
    RC_ASSERT(emptied == (taken == count ? 1U : 0U));
    count -= taken;
  }
  std::erase_if(expected, [](const auto& cell) { return cell.second == 0; });
  RC_ASSERT(listed(counts) == expected);
}

TEST(CellCounts, RemoveOfUncountedPoints_ReportsThemAndChangesNothing) {
  CellCounts counts(3);
  const std::vector<LatticePoint> points{{0, 0, 0}, {100, 0, 0}};
  counts.add(points);
  const std::vector<LatticePoint> strangers{{-1, 0, 0}, {100, 0, 0}, {101, 0, 0}};  // 101 shares the cell of 100.
  std::size_t emptied = 0;
  EXPECT_EQ(counts.remove(strangers, [&](const LatticeBox&) { ++emptied; }), 2U);
  EXPECT_EQ(emptied, 1U);
  EXPECT_EQ(counts.total(), 1U);
  EXPECT_EQ(counts.count_at({0, 0, 0}), 1U);
}

TEST(CellCounts, CountBeyondInt32_StaysExact) {
  constexpr std::uint64_t kMany = (std::uint64_t{1} << 33) + 5;
  CellCounts counts(0);
  counts.add({7, 7, 7}, kMany);
  counts.add({6, 7, 7}, (std::uint64_t{1} << 30) - 1);
  const std::vector<LatticePoint> one{{6, 7, 7}};
  counts.add(one);  // Exactly 2^30.
  EXPECT_EQ(counts.count_at({7, 7, 7}), kMany);
  EXPECT_EQ(counts.count_at({6, 7, 7}), std::uint64_t{1} << 30);
  EXPECT_EQ(classes_of(counts), classes_of(listed(counts))) << "of many points each";
  EXPECT_EQ(counts.coarsened(1).count_at({7, 7, 7}), kMany + (std::uint64_t{1} << 30));
  EXPECT_EQ(counts.remove(one, [](const LatticeBox&) { FAIL() << "the cell is far from empty"; }), 0U);
  EXPECT_EQ(counts.count_at({6, 7, 7}), (std::uint64_t{1} << 30) - 1);
  EXPECT_EQ(counts.total(), kMany + (std::uint64_t{1} << 30) - 1);
}

TEST(CellCounts, RemoveDownToACarriedCount_LeavesTheCellOccupied) {
  CellCounts counts(30);
  const LatticePoint p{1, 1, 1};
  counts.add(p, (std::uint64_t{1} << 30) + 1);
  const std::vector<LatticePoint> two(2, p);
  EXPECT_EQ(counts.remove(two, [&](const LatticeBox&) { FAIL() << "there are many more"; }), 0U);
  EXPECT_EQ(counts.count_at(p), (std::uint64_t{1} << 30) - 1);
  EXPECT_EQ(counts.active_cells(), 1U);
}

TEST(CellCounts, MoreLeavesThanAnyCacheHolds_StayApart) {
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<LatticePoint> line;
    for (std::int32_t i = 0; i < 6000; ++i) {
      line.push_back({axis == 0 ? 8 * i : 1, axis == 1 ? 8 * i : 2, axis == 2 ? 8 * i : 3});
    }
    CellCounts counts(0);
    counts.add(line);
    EXPECT_EQ(listed(counts), brute_force(line, 0));
  }
}

TEST(CellCounts, PointsAtTheEndsOfInt32_HaveTheirOwnCells) {
  constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min(),
                         kHigh = std::numeric_limits<std::int32_t>::max();
  const std::vector<LatticePoint> corners{{kLow, kLow, kLow}, {kHigh, kHigh, kHigh}, {kLow, kHigh, 0}};
  CellCounts counts(0);
  counts.add(corners);
  EXPECT_EQ(listed(counts), brute_force(corners, 0));
  EXPECT_EQ(listed(counts.coarsened(30)), brute_force(corners, 30));
}

}  // namespace
}  // namespace arris::tiling
