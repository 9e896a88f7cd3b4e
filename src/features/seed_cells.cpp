#include "features/seed_cells.h"

#include <algorithm>
#include <unordered_map>

namespace arris {
namespace {

std::int64_t floor_divide(std::int64_t a, std::int64_t b) {
  const std::int64_t q = a / b;
  return q - (a % b < 0);
}

struct CellHash {
  std::size_t operator()(const LatticePoint& c) const {
    std::uint64_t h = static_cast<std::uint32_t>(c.x) * 0x9E3779B97F4A7C15ULL;
    h = (h ^ (h >> 32) ^ static_cast<std::uint32_t>(c.y)) * 0x9E3779B97F4A7C15ULL;
    h = (h ^ (h >> 32) ^ static_cast<std::uint32_t>(c.z)) * 0x9E3779B97F4A7C15ULL;
    return h ^ (h >> 32);
  }
};

/// Squared distance of a centroid from the middle of a cell, in fractions of a step; exact.
std::uint64_t squared_from_middle(const VoxelTile& tile, std::size_t v, const LatticePoint& cell,
                                  const SupervoxelScale& scale) {
  static_assert(kVoxelFractions % 2 == 0, "the middle of a cell is a whole number of fractions");
  std::uint64_t sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t middle = kVoxelFractions / 2 * scale.seed_steps * (2 * std::int64_t{cell[axis]} + 1);
    const std::int64_t d = difference(tile.positions[v][static_cast<std::size_t>(axis)],
                                      static_cast<std::uint32_t>(static_cast<std::uint64_t>(middle)));
    sum += static_cast<std::uint64_t>(d * d);
  }
  return sum;
}

/// True if at least `scale.least_support` voxels are reached within R_search.
bool supported(const VoxelTile& tile, std::uint32_t seed, const SupervoxelScale& scale) {
  const double reach = static_cast<double>(kVoxelFractions) * static_cast<double>(scale.search_steps);
  std::vector<std::uint32_t> reached{seed};
  for (std::size_t i = 0; i < reached.size() && reached.size() < scale.least_support; ++i) {
    for (const std::uint32_t u : tile.neighbours_of(reached[i])) {
      double squared = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double d = difference(tile.positions[u][axis], tile.positions[seed][axis]);
        squared += d * d;
      }
      if (squared > reach * reach) continue;
      if (std::find(reached.begin(), reached.end(), u) == reached.end()) reached.push_back(u);
    }
  }
  return reached.size() >= scale.least_support;
}

}  // namespace

LatticePoint seed_cell(const LatticePoint& voxel, const SupervoxelScale& scale) {
  const auto cell = [&](std::int32_t key) {
    return static_cast<std::int32_t>(
        floor_divide((2 * std::int64_t{key} + 1) * scale.voxel_steps, 2 * scale.seed_steps));
  };
  return {cell(voxel.x), cell(voxel.y), cell(voxel.z)};
}

std::vector<Seed> find_seeds(const VoxelTile& tile, const SupervoxelScale& scale) {
  struct Best {
    std::uint64_t distance2 = ~std::uint64_t{0};
    std::uint32_t voxel = 0;
  };
  std::unordered_map<LatticePoint, Best, CellHash> cells;
  LatticePoint last_cell;
  Best* last = nullptr;
  for (std::uint32_t v = 0; v < tile.size(); ++v) {
    const LatticePoint cell = seed_cell(tile.keys[v], scale);
    if (last == nullptr || cell != last_cell) {
      last = &cells[cell];
      last_cell = cell;
    }
    const std::uint64_t distance2 = squared_from_middle(tile, v, cell, scale);
    if (distance2 < last->distance2) *last = {distance2, v};
  }
  std::vector<Seed> seeds;
  for (const auto& [cell, best] : cells) {
    if (tile.core[best.voxel] != 0 && supported(tile, best.voxel, scale)) seeds.push_back({cell, best.voxel});
  }
  std::sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) { return a.cell < b.cell; });
  return seeds;
}

}  // namespace arris
