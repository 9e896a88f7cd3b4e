#include "voxel_tile_testing.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "tiling/morton.h"

namespace arris::test {
namespace {

void link(VoxelTile& tile) {
  std::map<LatticePoint, std::uint32_t> at;
  for (std::uint32_t v = 0; v < tile.size(); ++v) at[tile.keys[v]] = v;
  tile.neighbour_begin.assign(1, 0);
  tile.neighbours.clear();
  for (const LatticePoint& key : tile.keys) {
    for (int i = 0; i < 27; ++i) {
      const auto found = at.find({key.x + i / 9 - 1, key.y + i / 3 % 3 - 1, key.z + i % 3 - 1});
      if (i != 13 && found != at.end()) tile.neighbours.push_back(found->second);
    }
    tile.neighbour_begin.push_back(static_cast<std::uint32_t>(tile.neighbours.size()));
  }
}

}  // namespace

VoxelTile voxel_tile_of(std::int32_t side, const std::vector<LatticePoint>& points,
                        const std::vector<RawColour>& colours) {
  struct Sums {
    std::int64_t n = 0;
    std::array<std::int64_t, 3> position{}, colour{};
  };
  const VoxelGrid grid(side);
  const auto in_order = [](const LatticePoint& a, const LatticePoint& b) { return tiling::z_order_less(a, b); };
  std::map<LatticePoint, Sums, decltype(in_order)> sums(in_order);
  for (std::size_t i = 0; i < points.size(); ++i) {
    Sums& s = sums[grid.voxel_of(points[i])];
    ++s.n;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      s.position[axis] += points[i][static_cast<int>(axis)];
      if (!colours.empty()) s.colour[axis] += colours[i][axis];
    }
  }
  VoxelTile tile(grid);
  for (const auto& [key, s] : sums) {
    VoxelPosition position;
    RawColour colour;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double mean = static_cast<double>(kVoxelFractions * s.position[axis]) / static_cast<double>(s.n);
      position[axis] = static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(mean + 0.5)));
      colour[axis] = static_cast<std::uint16_t>(s.colour[axis] / s.n);
    }
    tile.keys.push_back(key);
    tile.positions.push_back(position);
    if (!colours.empty()) tile.colours.push_back(colour);
    tile.ranks.push_back(static_cast<std::uint32_t>(tile.ranks.size()));
    tile.core.push_back(1);
  }
  link(tile);
  return tile;
}

VoxelTile part_of(const VoxelTile& tile, const LatticeBox& core, std::int64_t halo, std::vector<std::uint32_t>& from) {
  VoxelTile part(tile.grid);
  from.clear();
  const LatticeBox covered = core.expanded(halo);
  for (std::uint32_t v = 0; v < tile.size(); ++v) {
    if (!covered.contains(tile.keys[v])) continue;
    from.push_back(v);
    part.keys.push_back(tile.keys[v]);
    part.positions.push_back(tile.positions[v]);
    if (!tile.colours.empty()) part.colours.push_back(tile.colours[v]);
    part.ranks.push_back(tile.ranks[v]);
    part.core.push_back(core.contains(tile.keys[v]) ? 1 : 0);
  }
  link(part);
  return part;
}

VoxelFeatures part_of(const VoxelFeatures& features, const std::vector<std::uint32_t>& from) {
  VoxelFeatures part;
  for (const std::uint32_t v : from) {
    part.normals.push_back(features.normals[v]);
    if (!features.colours.empty()) part.colours.push_back(features.colours[v]);
    if (!features.histograms.empty()) part.histograms.push_back(features.histograms[v]);
  }
  return part;
}

VoxelTile moved(VoxelTile tile, const LatticePoint& voxels) {
  const std::int64_t side = std::int64_t{kVoxelFractions} * tile.grid.side_steps();
  for (std::size_t v = 0; v < tile.size(); ++v) {
    LatticePoint& key = tile.keys[v];
    key = {key.x + voxels.x, key.y + voxels.y, key.z + voxels.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
      tile.positions[v][axis] += static_cast<std::uint32_t>(side * voxels[static_cast<int>(axis)]);
  }
  return tile;
}

BumpySurface bumpy_surface(std::size_t points, std::int32_t width, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> noise(0.0, 0.01 * width);
  const double slope = unit(random) - 0.5;
  BumpySurface surface;
  while (surface.points.size() < points) {
    const double x = unit(random);
    const double y = unit(random);
    if (std::hypot(x - 0.3, y - 0.6) < 0.1) continue;
    const double z = 0.2 * std::sin(6.0 * x) * std::cos(5.0 * y) + slope * x + (y > 0.5 ? 0.3 : 0.0);
    const auto step = [&](double v) { return static_cast<std::int32_t>(std::lround((v - 0.5) * width)); };
    surface.points.push_back({step(x), step(y), step(z) + static_cast<std::int32_t>(noise(random))});
    const auto channel = [&](double v) { return static_cast<std::uint16_t>(65535.0 * std::clamp(v, 0.0, 1.0)); };
    surface.colours.push_back({channel(x), channel(std::floor(4.0 * y) / 4.0), channel(0.5 + z)});
  }
  return surface;
}

LatticeBox any_core(const VoxelTile& tile, std::mt19937_64& random) {
  LatticeBox core;
  core.include(tile.keys[random() % tile.size()]);
  core.include(tile.keys[random() % tile.size()]);
  return core;
}

}  // namespace arris::test
