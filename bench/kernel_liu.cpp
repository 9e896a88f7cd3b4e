// Times extract_liu on one tile in memory: points per CPU second, without any file. Not part of the default build.
//
//   kernel_liu [shape = box | plane] [points = 1000000] [noise in spacings = 0.1] [spacing in lattice steps = 25]
//   [threads = 1] [all]

#include <sys/resource.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "core/parallel.h"
#include "features/liu/liu_method.h"

namespace {

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Equal on every processor and with every compiler setting, or something is wrong.
std::uint64_t checksum(const arris::ContourRecords& records) {
  std::uint64_t sum = 0;
  for (const arris::ContourRecord& r : records) {
    for (const std::uint64_t part : {r.id, std::uint64_t{r.classes}, std::uint64_t{r.votes},
                                     std::uint64_t{std::bit_cast<std::uint32_t>(r.gap_deg)},
                                     std::uint64_t{std::bit_cast<std::uint32_t>(r.fold_strength)},
                                     std::uint64_t{std::bit_cast<std::uint32_t>(r.fold_angle_deg)}}) {
      sum = (sum ^ part) * 0x9e3779b97f4a7c15ULL;
      sum ^= sum >> 29;
    }
  }
  return sum;
}

/// Uniformly random points on a square or on the faces of a cube, with isotropic noise, in lattice steps.
arris::TilePoints cloud(const std::string& shape, std::size_t points, double noise, double spacing) {
  const int faces = shape == "plane" ? 1 : 6;
  const double side = spacing * std::sqrt(static_cast<double>(points) / faces);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> along(0.0, side);
  std::normal_distribution<double> off(0.0, std::max(noise * spacing, 1e-9));
  arris::TilePoints tile;
  for (std::size_t i = 0; i < points; ++i) {
    double p[3] = {along(random), along(random), 0.0};
    const int face = static_cast<int>(i % static_cast<std::size_t>(faces));
    if (face % 2 == 1) p[2] = side;
    std::rotate(p, p + face / 2, p + 3);
    for (double& c : p) c += off(random);
    tile.positions.push_back({static_cast<std::int32_t>(std::lround(p[0])),
                              static_cast<std::int32_t>(std::lround(p[1])),
                              static_cast<std::int32_t>(std::lround(p[2]))});
  }
  std::sort(tile.positions.begin(), tile.positions.end());
  tile.positions.erase(std::unique(tile.positions.begin(), tile.positions.end()), tile.positions.end());
  std::shuffle(tile.positions.begin(), tile.positions.end(), random);
  for (std::size_t i = 0; i < tile.positions.size(); ++i) tile.ids.push_back(i);
  tile.core.min = {-2147483648LL, -2147483648LL, -2147483648LL};
  tile.core.max = {2147483648LL, 2147483648LL, 2147483648LL};
  tile.covered = tile.core;
  return tile;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string shape = argc > 1 ? argv[1] : "box";
  const auto points = static_cast<std::size_t>(argc > 2 ? std::atof(argv[2]) : 1e6);
  const double noise = argc > 3 ? std::atof(argv[3]) : 0.1;
  const double spacing = argc > 4 ? std::atof(argv[4]) : 25.0;
  const int threads = argc > 5 ? std::atoi(argv[5]) : 1;
  const arris::TilePoints tile = cloud(shape, points, noise, spacing);
  arris::LiuParameters parameters;
  parameters.max_radius = 100.0 * spacing * 0.001;
  const arris::Lattice lattice{0.001, {0.0, 0.0, 0.0}};
  const auto time = [&](const char* what) {
    const arris::ThreadLimit limit(threads);
    const double before = cpu_seconds();
    const arris::TileContours found = extract_liu(tile, lattice, parameters);
    const double seconds = cpu_seconds() - before;
    std::printf("%-16s %9zu points  %8zu records (%016llx)  %6.3f CPU s  %.3f M points per CPU second\n", what,
                tile.positions.size(), found.records.size(), static_cast<unsigned long long>(checksum(found.records)),
                seconds, static_cast<double>(tile.positions.size()) / seconds * 1e-6);
  };
  time("all");
  if (argc > 6) return 0;
  parameters.fold = false;
  time("boundary only");
  parameters.fold = true;
  parameters.boundary = false;
  time("fold only");
  parameters.fold = false;
  time("neighbours only");
  return 0;
}
