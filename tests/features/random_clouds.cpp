#include "random_clouds.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

namespace arris::test {

std::string name(Shape shape) {
  constexpr const char* kNames[] = {"plane",     "fold",       "grid",         "grid fold", "volume",
                                    "collinear", "two layers", "density step", "clusters"};
  return kNames[static_cast<int>(shape)];
}

std::vector<LatticePoint> random_positions(Shape shape, std::size_t points, double extent, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-0.5, 0.5);
  std::normal_distribution<double> normal(0.0, 1.0);
  const double spacing = extent / std::sqrt(static_cast<double>(points));
  const double tilt[3] = {unit(random), unit(random), unit(random)};
  const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(points)));
  const double pitch = std::max(1.0, std::floor(spacing));
  std::vector<LatticePoint> positions;
  for (std::size_t i = 0; i < points; ++i) {
    double p[3] = {unit(random) * extent, unit(random) * extent, 0.1 * spacing * normal(random)};
    const auto row = static_cast<double>(i / side);
    const auto column = static_cast<double>(i % side);
    switch (shape) {
      case Shape::kPlane:
        p[2] += tilt[0] * p[0] + tilt[1] * p[1];
        break;
      case Shape::kFold:
        p[2] += (1.0 + tilt[2]) * std::fabs(p[0]) + tilt[1] * p[1];
        break;
      case Shape::kGrid:
        p[0] = pitch * row;
        p[1] = pitch * column;
        p[2] = 0.0;
        break;
      case Shape::kGridFold:
        p[0] = pitch * std::max(0.0, row - static_cast<double>(side) / 2);
        p[1] = pitch * column;
        p[2] = pitch * std::max(0.0, std::floor(static_cast<double>(side) / 2) - row);
        break;
      case Shape::kVolume:
        p[2] = unit(random) * extent;
        break;
      case Shape::kCollinear:
        p[1] = 2.0 * std::floor(p[0]);
        p[2] = -3.0 * std::floor(p[0]);
        p[0] = std::floor(p[0]);
        break;
      case Shape::kTwoLayers:
        p[2] += i % 2 ? 4.0 * spacing : 0.0;
        break;
      case Shape::kDensityStep:
        if (i % 2 == 0) {
          p[0] = 0.1 * p[0] - extent / 4;
          p[1] = 0.1 * p[1];
        }
        break;
      case Shape::kClusters:
        if (i % 50 == 0) break;
        for (double& c : p) c = std::round(c / extent * 2.0) * extent + 0.05 * spacing * normal(random) * 40.0;
        break;
    }
    positions.push_back({static_cast<std::int32_t>(std::lround(p[0])), static_cast<std::int32_t>(std::lround(p[1])),
                         static_cast<std::int32_t>(std::lround(p[2]))});
    if (i % 20 == 0) positions.push_back(positions[positions.size() / 2]);
  }
  return positions;
}

TilePoints tile_of(std::span<const LatticePoint> positions, std::uint64_t seed) {
  std::vector<std::uint64_t> ids(positions.size());
  std::iota(ids.begin(), ids.end(), std::uint64_t{1000});
  std::shuffle(ids.begin(), ids.end(), std::mt19937_64(seed));
  std::map<LatticePoint, std::vector<std::uint64_t>> at;
  for (std::size_t i = 0; i < positions.size(); ++i) at[positions[i]].push_back(ids[i]);
  TilePoints tile;
  for (auto& [position, here] : at) {
    std::sort(here.begin(), here.end());
    for (std::size_t i = 1; i < here.size(); ++i) {
      tile.duplicates.emplace_back(here[i], static_cast<std::uint32_t>(tile.positions.size()));
    }
    tile.positions.push_back(position);
    tile.ids.push_back(here[0]);
  }
  tile.core = everything();
  tile.covered = everything();
  return tile;
}

TilePoints tile_of(const std::vector<LatticePoint>& positions, std::uint64_t seed) {
  return tile_of(std::span(positions), seed);
}

LatticeBox everything() {
  constexpr std::int64_t kFar = std::int64_t{1} << 34;
  return {{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}};
}

}  // namespace arris::test
