#include "features/supervoxel/seed_cells.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "voxel_tile_testing.h"

namespace arris {
namespace {

SupervoxelScale scale_of(std::int32_t voxel, std::int64_t seed, std::uint32_t support = 0) {
  SupervoxelScale scale;
  scale.voxel_steps = voxel;
  scale.seed_steps = seed;
  scale.search_steps = seed / 2;
  scale.least_support = support;
  return scale;
}

RC_GTEST_PROP(SeedCell, AnyVoxel_HasItsMiddleInIt, ()) {
  const auto voxel = *rc::gen::oneOf(rc::gen::inRange(1, 50), rc::gen::inRange(1, kMostVoxelSide)).as("voxel");
  const auto seed = *rc::gen::inRange<std::int64_t>(2 * std::int64_t{voxel},
                                                    std::min(kMostSeedSteps, 1000 * std::int64_t{voxel}) + 1);
  const VoxelGrid grid(voxel);
  const auto key = [&] { return grid.voxel_of(*rc::gen::arbitrary<std::int32_t>()); };
  const LatticePoint at{key(), key(), key()};
  const LatticePoint cell = seed_cell(at, scale_of(voxel, seed));
  for (int axis = 0; axis < 3; ++axis) {
    const __int128 twice_middle = 2 * static_cast<__int128>(grid.corner(at[axis])) + voxel;
    const __int128 twice_low = (2 * static_cast<__int128>(cell[axis]) - 1) * seed;
    RC_ASSERT(twice_low <= twice_middle);
    RC_ASSERT(twice_middle < twice_low + 2 * seed);
  }
}

/// In fractions of a step; tiles near the origin.
std::array<std::int64_t, 3> position(const VoxelTile& tile, std::uint32_t v) {
  return {static_cast<std::int32_t>(tile.positions[v][0]), static_cast<std::int32_t>(tile.positions[v][1]),
          static_cast<std::int32_t>(tile.positions[v][2])};
}
std::int64_t squared(const std::array<std::int64_t, 3>& a, const std::array<std::int64_t, 3>& b) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

std::size_t reachable(const VoxelTile& tile, std::uint32_t seed, const SupervoxelScale& scale) {
  const std::int64_t radius = kVoxelFractions * scale.search_steps;
  std::set<std::uint32_t> reached{seed};
  std::vector<std::uint32_t> queue{seed};
  while (!queue.empty()) {
    const std::uint32_t v = queue.back();
    queue.pop_back();
    for (const std::uint32_t u : tile.neighbours_of(v)) {
      if (squared(position(tile, u), position(tile, seed)) <= radius * radius && reached.insert(u).second)
        queue.push_back(u);
    }
  }
  return reached.size();
}

struct Best {
  std::int64_t distance2;
  std::uint32_t voxel;
  bool supported;
};

std::vector<Seed> seeds_by_definition(const VoxelTile& tile, const SupervoxelScale& scale) {
  std::map<LatticePoint, Best> best;
  for (std::uint32_t v = 0; v < tile.size(); ++v) {
    const LatticePoint cell = seed_cell(tile.keys[v], scale);
    const std::int64_t edge = kVoxelFractions * scale.seed_steps;
    const std::int64_t d2 = squared(position(tile, v), {edge * cell.x, edge * cell.y, edge * cell.z});
    const auto [at, fresh] = best.try_emplace(cell, Best{d2, v, false});
    if (!fresh && d2 < at->second.distance2) at->second = {d2, v, false};
  }
  for (auto& [cell, b] : best) b.supported = reachable(tile, b.voxel, scale) >= scale.least_support;
  std::vector<Seed> seeds;
  for (const auto& [cell, b] : best) {
    if (tile.core[b.voxel] == 0 || !b.supported) continue;
    bool crowded = false;
    for (const auto& [other_cell, other] : best) {
      const auto far = [](std::int32_t p, std::int32_t q) { return std::abs(p - q) > 1; };
      if (other_cell == cell || !other.supported || far(cell.x, other_cell.x) || far(cell.y, other_cell.y) ||
          far(cell.z, other_cell.z))
        continue;
      const double apart =
          std::sqrt(static_cast<double>(squared(position(tile, b.voxel), position(tile, other.voxel))));
      const bool nearer = std::pair(other.distance2, other_cell) < std::pair(b.distance2, cell);
      crowded = crowded || (nearer && apart < static_cast<double>(kVoxelFractions * scale.seed_steps) / 3.0);
    }
    if (!crowded) seeds.push_back({cell, b.voxel});
  }
  return seeds;
}

bool same(const std::vector<Seed>& a, const std::vector<Seed>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Seed& s, const Seed& t) { return s.cell == t.cell && s.voxel == t.voxel; });
}

RC_GTEST_PROP(Seeds, AnySurface_AreThoseOfTheDefinition, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>().as("seed"));
  const auto voxel = *rc::gen::inRange(5, 40).as("voxel");
  const auto seed = *rc::gen::inRange<std::int64_t>(2 * voxel, 12 * voxel).as("seed steps");
  const auto support = *rc::gen::inRange<std::uint32_t>(0, 12).as("support");
  VoxelTile tile = test::voxel_tile_of(voxel, test::bumpy_surface(2000, 1000, random()).points);
  const LatticeBox core = test::any_core(tile, random);
  for (std::size_t v = 0; v < tile.size(); ++v) tile.core[v] = core.contains(tile.keys[v]) ? 1 : 0;
  const SupervoxelScale scale = scale_of(voxel, seed, support);
  RC_ASSERT(same(find_seeds(tile, scale), seeds_by_definition(tile, scale)));
}

// The law that tiles rely on: what a tile must cover for its seeds to be right.
RC_GTEST_PROP(Seeds, CutWhereTheHeaderSays_AreThoseOfTheWhole, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>().as("seed"));
  constexpr std::int32_t kVoxel = 20;
  const auto seed = *rc::gen::inRange<std::int64_t>(2 * kVoxel, 6 * kVoxel).as("seed steps");
  const SupervoxelScale scale = scale_of(kVoxel, seed, 4);
  const VoxelTile tile = test::voxel_tile_of(kVoxel, test::bumpy_surface(4000, 1500, random()).points);
  const LatticeBox core = test::any_core(tile, random);
  const auto halo = static_cast<std::int64_t>(std::ceil(2.5 * static_cast<double>(seed) / kVoxel)) + 2;
  std::vector<std::uint32_t> from;
  const VoxelTile part = test::part_of(tile, core, halo, from);
  std::vector<Seed> expected;
  for (const Seed& s : find_seeds(tile, scale)) {
    if (core.contains(tile.keys[s.voxel])) expected.push_back(s);
  }
  std::vector<Seed> seeds = find_seeds(part, scale);
  for (Seed& s : seeds) s.voxel = from[s.voxel];
  RC_ASSERT(same(seeds, expected));
}

TEST(Seeds, FlatPlaneInTheMiddleOfCells_HasOneSeedPerCellInItsMiddle) {
  std::vector<LatticePoint> points;
  for (std::int32_t i = -160; i < 160; ++i) {
    for (std::int32_t j = -160; j < 160; ++j) points.push_back({i, j, 0});
  }
  const VoxelTile tile = test::voxel_tile_of(4, points);
  const std::vector<Seed> seeds = find_seeds(tile, scale_of(4, 40, 9));
  int whole = 0;
  for (const Seed& seed : seeds) {
    const LatticePoint& c = seed.cell;
    EXPECT_EQ(c.z, 0);
    if (std::max(std::abs(c.x), std::abs(c.y)) == 4) continue;  // At the border.
    ++whole;
    EXPECT_EQ(tile.keys[seed.voxel], (LatticePoint{10 * c.x, 10 * c.y, 0}));
  }
  EXPECT_EQ(whole, 49);
}

TEST(Seeds, NoisyPlaneAlongTheFacesOfCells_IsNotSeededTwice) {
  // The face between cells 0 and 1 lies at 20: half of the voxels fall into either layer of cells.
  std::mt19937_64 random(1);
  std::vector<LatticePoint> points;
  for (std::int32_t i = -140; i < 140; ++i) {
    for (std::int32_t j = -140; j < 140; ++j)
      points.push_back({i, j, 20 + static_cast<std::int32_t>(random() % 7) - 3});
  }
  const VoxelTile tile = test::voxel_tile_of(4, points);
  const std::vector<Seed> seeds = find_seeds(tile, scale_of(4, 40, 9));
  EXPECT_GE(seeds.size(), 49U) << "one per pair of cells at least";
  EXPECT_LT(seeds.size(), 98U) << "one per cell";
  for (const Seed& a : seeds) {
    for (const Seed& b : seeds) {
      if (a.voxel == b.voxel) continue;
      const double apart = std::sqrt(static_cast<double>(squared(position(tile, a.voxel), position(tile, b.voxel))));
      EXPECT_GE(apart, kVoxelFractions * 40 / 3.0);
    }
  }
}

TEST(Seeds, SpecksWithoutSupport_GiveNone) {
  std::vector<LatticePoint> points{{0, 0, 0}, {400, 0, 0}, {404, 0, 0}, {408, 4, 0}};
  const VoxelTile tile = test::voxel_tile_of(4, points);
  EXPECT_EQ(find_seeds(tile, scale_of(4, 40, 1)).size(), 2U);
  EXPECT_EQ(find_seeds(tile, scale_of(4, 40, 2)).size(), 1U);
  EXPECT_EQ(find_seeds(tile, scale_of(4, 40, 3)).size(), 1U);
  EXPECT_EQ(find_seeds(tile, scale_of(4, 40, 4)).size(), 0U);
}

}  // namespace
}  // namespace arris
