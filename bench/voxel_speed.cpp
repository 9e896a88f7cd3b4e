/// Speed of the voxels: CPU time per point of the accumulator, of look-ups in the index, and of loading the store.
///   voxel_speed FOLDER SIDE TABLE_MIB STEP INPUT...     lengths: SIDE in lattice steps, STEP in data units
/// Best of three runs each.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/process_memory.h"
#include "io/point_source.h"
#include "tiling/lattice_mapper.h"
#include "tiling/voxel_accumulator.h"

namespace {

constexpr std::size_t kBatch = 16384;
constexpr int kRuns = 3;

double cpu_seconds() {
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Nanoseconds of CPU per `count`, best of the runs.
template <typename Work>
double best_ns(std::size_t count, Work&& work) {
  double best = 1e300;
  for (int i = 0; i < kRuns; ++i) {
    const double before = cpu_seconds();
    work();
    best = std::min(best, (cpu_seconds() - before) * 1e9 / static_cast<double>(std::max<std::size_t>(count, 1)));
  }
  return best;
}

std::vector<arris::LatticePoint> read_points(const std::vector<std::filesystem::path>& paths, double step) {
  arris::io::InputSet inputs(paths);
  arris::Lattice lattice;
  lattice.step = step;
  const arris::tiling::LatticeMapper mapper(inputs.sources(), lattice);
  std::vector<arris::LatticePoint> points, batch_points;
  std::vector<arris::tiling::Mapped> outcome;
  arris::io::PointBatch batch;
  while (inputs.read(batch, {})) {
    mapper.map(batch, inputs.source_index(), batch_points, outcome);
    for (std::size_t i = 0; i < batch_points.size(); ++i) {
      if (outcome[i] == arris::tiling::Mapped::kOk) points.push_back(batch_points[i]);
    }
  }
  return points;
}

void measure_index(const arris::tiling::VoxelStore& store, const std::vector<arris::LatticePoint>& points,
                   const std::vector<arris::Voxel>& voxels) {
  std::uint64_t sum = 0;
  const arris::VoxelGrid grid = store.grid();
  const arris::tiling::VoxelIndex& index = store.index();
  const double divide = best_ns(points.size(), [&] {
    for (const arris::LatticePoint& p : points) {
      const arris::LatticePoint key = grid.voxel_of(p);
      sum += static_cast<std::uint32_t>(key.x ^ key.y ^ key.z);
    }
  });
  const double rank = best_ns(points.size(), [&] {
    std::uint32_t hint = 0;
    for (const arris::LatticePoint& p : points) sum += index.rank(grid.voxel_of(p), hint);
  });
  std::size_t found = 0;
  const double neighbours = best_ns(voxels.size() * 26, [&] {
    found = 0;
    std::uint32_t hint = 0;
    for (const arris::Voxel& voxel : voxels) {
      for (int i = 0; i < 27; ++i) {
        if (i == 13) continue;
        const arris::LatticePoint key{voxel.key.x + i / 9 - 1, voxel.key.y + i / 3 % 3 - 1, voxel.key.z + i % 3 - 1};
        found += index.rank(key, hint) != arris::tiling::VoxelIndex::kNone;
      }
    }
  });
  const double around = best_ns(voxels.size(), [&] {
    std::uint32_t hint = 0;
    std::array<std::uint32_t, 27> ranks{};
    for (const arris::Voxel& voxel : voxels) {
      index.ranks_around(voxel.key, hint, ranks);
      sum += ranks[0] + ranks[26];
    }
  });
  fmt::print("ranks_around {:.1f} ns per voxel\n", around);
  fmt::print(
      "voxel_of {:.1f} ns, rank of all points {:.1f} ns more, rank of 26 neighbours {:.1f} ns each ({:.1f} of 26 "
      "exist, {})\n",
      divide, rank - divide, neighbours, static_cast<double>(found) / static_cast<double>(voxels.size()), sum & 1);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 6) return 2;
  arris::configure_allocator_for_budget();
  const arris::VoxelGrid grid(std::atoi(argv[2]));
  const std::size_t table_bytes = static_cast<std::size_t>(std::atoi(argv[3])) << 20;
  const auto points = read_points({argv + 5, argv + argc}, std::atof(argv[4]));
  const std::uint64_t resident = arris::resident_bytes();
  std::optional<arris::tiling::VoxelStore> store;
  std::uint64_t disk = 0;
  const double total = best_ns(points.size(), [&] {
    store.reset();
    arris::tiling::VoxelAccumulator accumulator(grid, {argv[1], table_bytes});
    for (std::size_t i = 0; i < points.size(); i += kBatch) {
      accumulator.add(std::span(points).subspan(i, std::min(kBatch, points.size() - i)));
    }
    store.emplace(accumulator.finish());
    disk = accumulator.bytes_on_disk();
  });
  fmt::print(
      "{} points, {} voxels: {:.1f} ns CPU per point; index {:.2f} bytes per voxel, {} blocks; peak {:.1f} MiB above "
      "the points; "
      "{:.1f} MiB of disk\n",
      points.size(), store->size(), total, static_cast<double>(store->index().memory_bytes()) / store->size(),
      store->index().blocks(), static_cast<double>(arris::peak_resident_bytes() - resident) / (1 << 20),
      static_cast<double>(disk) / (1 << 20));
  std::vector<arris::Voxel> voxels;
  std::vector<std::uint32_t> ranks;
  const double load = best_ns(store->size(), [&] { store->load(store->index().bounds(), voxels, ranks); });
  fmt::print("load {:.1f} ns CPU per voxel\n", load);
  measure_index(*store, points, voxels);
}
