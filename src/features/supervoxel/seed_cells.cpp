#include "features/supervoxel/seed_cells.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include "core/pages.h"
#include "core/parallel.h"

namespace arris {
namespace {

/// Seeds of neighbouring cells are not nearer than this share of R_seed.
constexpr double kLeastSeedDistance = 1.0 / 3.0;
constexpr std::size_t kGrain = 16 * 1024;  // Voxels.
constexpr std::size_t kCellGrain = 512;

std::int64_t floor_divide(std::int64_t a, std::int64_t b) {
  const std::int64_t q = a / b;
  return q - (a % b < 0);
}

/// Squared distance of a centroid from the middle of a cell, in fractions of a step; exact.
std::uint64_t squared_from_middle(const VoxelTile& tile, std::size_t v, const LatticePoint& cell,
                                  const SupervoxelScale& scale) {
  std::uint64_t sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t middle = kVoxelFractions * scale.seed_steps * std::int64_t{cell[axis]};
    const std::int64_t d = difference(tile.positions[v][static_cast<std::size_t>(axis)],
                                      static_cast<std::uint32_t>(static_cast<std::uint64_t>(middle)));
    sum += static_cast<std::uint64_t>(d * d);
  }
  return sum;
}

double squared_between(const VoxelTile& tile, std::uint32_t a, std::uint32_t b) {
  double squared = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double d = difference(tile.positions[a][axis], tile.positions[b][axis]);
    squared += d * d;
  }
  return squared;
}

/// True if at least `scale.least_support` voxels are reached within R_search.
bool supported(const VoxelTile& tile, std::uint32_t seed, const SupervoxelScale& scale) {
  const double reach = static_cast<double>(kVoxelFractions) * static_cast<double>(scale.search_steps);
  std::vector<std::uint32_t> reached{seed};
  for (std::size_t i = 0; i < reached.size() && reached.size() < scale.least_support; ++i) {
    for (const std::uint32_t u : tile.neighbours_of(reached[i])) {
      if (squared_between(tile, u, seed) > reach * reach) continue;
      if (std::find(reached.begin(), reached.end(), u) == reached.end()) reached.push_back(u);
    }
  }
  return reached.size() >= scale.least_support;
}

}  // namespace

LatticePoint seed_cell(const LatticePoint& voxel, const SupervoxelScale& scale) {
  // Twice the middle of a voxel is 2 key side, and 1 more for odd sides (core/voxel.h); cells are centred likewise.
  const std::int64_t odd = scale.voxel_steps % 2;
  const auto cell = [&](std::int32_t key) {
    const std::int64_t twice_middle = 2 * std::int64_t{key} * scale.voxel_steps + odd;
    return static_cast<std::int32_t>(floor_divide(twice_middle + scale.seed_steps, 2 * scale.seed_steps));
  };
  return {cell(voxel.x), cell(voxel.y), cell(voxel.z)};
}

namespace {

/// Keys of the voxels whose middles lie in a cell.
LatticeBox keys_of(const LatticePoint& cell, const SupervoxelScale& scale) {
  const std::int64_t odd = scale.voxel_steps % 2;
  const auto first = [&](std::int64_t at) {  // The smallest key that seed_cell() puts into cell `at`.
    return -floor_divide(odd + scale.seed_steps - 2 * scale.seed_steps * at, 2 * std::int64_t{scale.voxel_steps});
  };
  LatticeBox keys;
  for (int axis = 0; axis < 3; ++axis) {
    keys.min[axis] = first(cell[axis]);
    keys.max[axis] = first(std::int64_t{cell[axis]} + 1);
  }
  return keys;
}

/// A cell's best voxel.
struct CellSeed {
  LatticePoint cell;
  std::uint32_t voxel = 0;
  std::uint64_t distance2 = ~std::uint64_t{0};  ///< From the middle of the cell.
  bool supported = false;
};
/// By cells. A list and not a map: where points are far apart there are as many cells as voxels.
using CellSeeds = PageVector<CellSeed>;

/// By cells, in each the best first: the nearest, ties: the first voxel.
std::tuple<const LatticePoint&, std::uint64_t, std::uint32_t> order_of(const CellSeed& s) {
  return {s.cell, s.distance2, s.voxel};
}

/// Of a sorted list.
void keep_best(CellSeeds& cells) {
  const auto rest = std::ranges::unique(cells, {}, &CellSeed::cell);
  cells.erase(rest.begin(), rest.end());
}

CellSeeds best_of_cells(const VoxelTile& tile, const SupervoxelScale& scale, std::uint32_t begin, std::uint32_t end) {
  CellSeeds cells;
  LatticeBox keys;  // Of the last cell.
  for (std::uint32_t v = begin; v < end; ++v) {
    if (!keys.contains(tile.keys[v])) {  // In Z-order the next voxel mostly lies in the same cell.
      cells.push_back({seed_cell(tile.keys[v], scale)});
      keys = keys_of(cells.back().cell, scale);
    }
    CellSeed& last = cells.back();
    const std::uint64_t distance2 = squared_from_middle(tile, v, last.cell, scale);
    if (distance2 < last.distance2) {
      last.distance2 = distance2;
      last.voxel = v;
    }
  }
  std::ranges::sort(cells, {}, order_of);
  keep_best(cells);
  return cells;
}

/// Lists of parts of the tile, each with the next one, until there is one.
CellSeeds best_of_cells(const VoxelTile& tile, const SupervoxelScale& scale) {
  std::vector<CellSeeds> lists((tile.size() + kGrain - 1) / kGrain);
  parallel_for_chunks(tile.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    lists[begin / kGrain] =
        best_of_cells(tile, scale, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end));
  });
  while (lists.size() > 1) {
    std::vector<CellSeeds> merged((lists.size() + 1) / 2);
    parallel_for_chunks(merged.size(), 1, [&](std::size_t i, std::size_t) {
      if (2 * i + 1 == lists.size()) {
        merged[i] = std::move(lists[2 * i]);
        return;
      }
      CellSeeds first = std::move(lists[2 * i]), second = std::move(lists[2 * i + 1]);
      merged[i].resize(first.size() + second.size());
      std::ranges::merge(first, second, merged[i].begin(), {}, order_of, order_of);
      keep_best(merged[i]);
    });
    lists = std::move(merged);
  }
  return lists.empty() ? CellSeeds{} : std::move(lists.front());
}

/// True if a neighbouring cell has a seed so near that both stand on the same spot of a surface that runs along the
/// face between the cells, and that one is nearer to the middle of its cell (ties: the smaller cell).
bool crowded_out(const VoxelTile& tile, const CellSeeds& cells, const CellSeed& seed, double least_distance) {
  const LatticePoint& cell = seed.cell;
  for (int i = 0; i < 9; ++i) {
    const LatticePoint first{cell.x + i / 3 - 1, cell.y + i % 3 - 1, cell.z - 1};
    const LatticePoint last{first.x, first.y, cell.z + 1};
    for (auto other = std::ranges::lower_bound(cells, first, {}, &CellSeed::cell);
         other != cells.end() && !(last < other->cell); ++other) {
      if (other->cell == cell || !other->supported) continue;
      if (squared_between(tile, seed.voxel, other->voxel) >= least_distance * least_distance) continue;
      if (std::pair(other->distance2, other->cell) < std::pair(seed.distance2, cell)) return true;
    }
  }
  return false;
}

}  // namespace

std::vector<Seed> find_seeds(const VoxelTile& tile, const SupervoxelScale& scale) {
  CellSeeds cells = best_of_cells(tile, scale);
  parallel_for_chunks(cells.size(), kCellGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) cells[i].supported = supported(tile, cells[i].voxel, scale);
  });
  const double least_distance =
      kLeastSeedDistance * static_cast<double>(kVoxelFractions) * static_cast<double>(scale.seed_steps);
  std::vector<std::vector<Seed>> found((cells.size() + kCellGrain - 1) / kCellGrain);
  parallel_for_chunks(cells.size(), kCellGrain, [&](std::size_t begin, std::size_t end) {
    for (const CellSeed& seed : std::span(cells).subspan(begin, end - begin)) {
      if (tile.core[seed.voxel] == 0 || !seed.supported) continue;
      if (!crowded_out(tile, cells, seed, least_distance)) found[begin / kCellGrain].push_back({seed.cell, seed.voxel});
    }
  });
  std::vector<Seed> seeds;
  for (const std::vector<Seed>& some : found) seeds.insert(seeds.end(), some.begin(), some.end());
  return seeds;
}

}  // namespace arris
