#pragma once
/// @file Clouds for properties: awkward on purpose (negative, straddling the origin, at the ends of int32, with
/// duplicates).

#include <rapidcheck.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "core/lattice.h"

namespace arris::test {

inline std::int32_t clamp_to_int32(std::int64_t v) {
  return static_cast<std::int32_t>(
      std::clamp<std::int64_t>(v, std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()));
}

/// `size` points in a few clusters of random widths; one in eight repeats an earlier one.
inline std::vector<LatticePoint> random_cloud(std::uint64_t seed, std::size_t size) {
  std::mt19937_64 random(seed);
  const auto below = [&](std::uint64_t n) { return static_cast<std::int64_t>(random() % n); };
  struct Cluster {
    std::int64_t x, y, z, width, thickness;
  };
  std::vector<Cluster> clusters(1 + random() % 4);
  for (Cluster& cluster : clusters) {
    const auto centre = [&]() -> std::int64_t {
      switch (random() % 4) {
        case 0:
          return 0;
        case 1:
          return below(2'000'000) - 1'000'000;
        case 2:
          return random() % 2 ? std::numeric_limits<std::int32_t>::max() : std::numeric_limits<std::int32_t>::min();
        default:
          return static_cast<std::int32_t>(random());
      }
    };
    cluster = {centre(), centre(), centre(), std::int64_t{1} << below(20), 1};
    cluster.thickness = random() % 2 ? cluster.width : 1;
  }
  std::vector<LatticePoint> points;
  for (std::size_t i = 0; i < size; ++i) {
    if (i > 0 && random() % 8 == 0) {
      points.push_back(points[random() % i]);
      continue;
    }
    const Cluster& c = clusters[random() % clusters.size()];
    const auto offset = [&](std::int64_t width) { return below(static_cast<std::uint64_t>(width)) - width / 2; };
    points.push_back({clamp_to_int32(c.x + offset(c.width)), clamp_to_int32(c.y + offset(c.width)),
                      clamp_to_int32(c.z + offset(c.thickness))});
  }
  return points;
}

/// A cloud drawn by RapidCheck: its seed and size are printed on failure.
inline std::vector<LatticePoint> any_cloud(std::size_t least, std::size_t most) {
  const auto seed = *rc::gen::arbitrary<std::uint64_t>().as("cloud seed");
  const auto size = *rc::gen::inRange<std::size_t>(least, most + 1).as("cloud size");
  return random_cloud(seed, size);
}

/// A square grid of n x n points in the plane z = 0, `spacing` steps apart, from (corner, corner).
inline std::vector<LatticePoint> plane_grid(std::int32_t n, std::int32_t spacing, std::int32_t corner = 0) {
  std::vector<LatticePoint> points;
  for (std::int32_t i = 0; i < n; ++i) {
    for (std::int32_t j = 0; j < n; ++j) points.push_back({corner + i * spacing, corner + j * spacing, 0});
  }
  return points;
}

}  // namespace arris::test
