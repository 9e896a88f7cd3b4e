/// @file The streaming passes alone: survey, partition and tile files while points are routed, and reading them back.
/// Usage: tile_speed THREADS FOLDER TILE_POINTS HALO INPUT...
/// HALO in data units; the folder must exist and be empty. Prints CPU and wall seconds of each pass and points of the
/// input per second of either.

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "stage_clock.h"
#include "tiling/partition.h"
#include "tiling/survey.h"
#include "tiling/tile_plan.h"
#include "tiling/tile_store.h"

namespace {

using namespace arris;

class Silent : public ProgressSink {
  void phase(std::string_view, std::uint64_t) override {}
  void advance(std::uint64_t) override {}
  void warning(std::string_view, std::string_view) override {}
  void note(std::string_view) override {}
};

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

int run(int threads, const std::filesystem::path& folder, std::uint64_t tile_points, double halo,
        const std::vector<std::filesystem::path>& paths) {
  const ThreadLimit limit(threads);
  io::InputSet inputs(paths);
  Silent silent;
  bench::StageClock clock;
  const double cpu_begin = bench::cpu_seconds();
  const auto begin = std::chrono::steady_clock::now();
  const tiling::Survey survey = tiling::survey_inputs(inputs, {}, silent, CancelToken());
  clock.end_stage("survey");
  tiling::PlanRequest request;
  request.max_points = tile_points;
  request.max_radius = halo;
  request.halo = [&](double) { return halo; };
  const tiling::TilePlan plan = tiling::plan_tiles(survey, request);
  tiling::TileStore store(folder, survey.lattice, plan, "");
  if (threads == 1) {
    tiling::partition_points(
        inputs, survey, plan, {folder}, [&](std::size_t tile) { store.build(tile); }, silent, CancelToken());
  } else {  // As runs do: tiles are built while points are still being routed.
    BackgroundTasks builders(threads);
    tiling::partition_points(
        inputs, survey, plan, {folder}, [&](std::size_t tile) { builders.run([&, tile] { store.build(tile); }); },
        silent, CancelToken());
    builders.wait();
  }
  clock.end_stage("partition");
  const double cpu = bench::cpu_seconds() - cpu_begin, wall = seconds_since(begin);
  std::size_t loaded = 0;
  for (std::size_t tile = 0; tile < plan.tiles.size(); ++tile) loaded += store.load(tile).positions.size();
  clock.end_stage("load");
  const auto millions = 1e-6 * static_cast<double>(survey.points());
  fmt::print(
      "points {}, tiles {}, stored {} ({:.2f} copies), {:.1f} bytes each on disk; survey, partition and tile files: "
      "{:.1f} M points per CPU s, {:.1f} per s with {} threads\n",
      survey.points(), plan.tiles.size(), loaded, 1e-6 * static_cast<double>(loaded) / millions,
      static_cast<double>(store.bytes_on_disk()) / static_cast<double>(loaded), millions / cpu, millions / wall,
      threads);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 6 || std::atoi(argv[1]) < 1) {
    std::fprintf(stderr, "usage: tile_speed THREADS FOLDER TILE_POINTS HALO INPUT...\n");
    return 2;
  }
  try {
    return run(std::atoi(argv[1]), argv[2], std::strtoull(argv[3], nullptr, 10), std::atof(argv[4]),
               {argv + 5, argv + argc});
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_code();
  }
}
