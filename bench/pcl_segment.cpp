/// @file The peer of arris segment: PCL's normals and region growing, everything in memory.
/// Usage: bench_pcl_segment SCAN K ANGLE CURVATURE MIN [OUT] [--normal-neighbours N] [--threads N]
/// Settings as in pcl_region_growing.h, ANGLE in degrees. Prints points, segments, CPU and wall seconds of each stage,
/// and the peak of resident memory. OUT (.las, .ply): every point of the scan with its SegmentId, for arris evaluate.
/// --normal-neighbours: of the normals alone (default K). --threads: of the normals (default 1); growth has one.

#include <pcl/console/print.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/error.h"
#include "label_output.h"
#include "pcl_region_growing.h"
#include "stage_clock.h"

namespace {

using namespace arris::bench;

int run(const std::string& scan, const std::string& out, const GrowingSettings& settings, int normal_neighbours,
        unsigned threads) {
  StageClock clock;
  const PclCloud::Ptr cloud = read_cloud(scan);
  clock.end_stage("read");
  const PclSearch::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>);
  const PclNormals::Ptr normals = estimate_normals(cloud, tree, normal_neighbours, threads);
  clock.end_stage("normals");
  const std::vector<std::uint32_t> labels = grow_regions(cloud, tree, normals, settings);
  clock.end_stage("grow");
  if (!out.empty()) {
    write_labels(scan, out, {"SegmentId", arris::ColumnType::kUint32, "segment; 0: none"}, labels);
    clock.end_stage("write");
  }
  const auto unlabelled = static_cast<std::size_t>(std::count(labels.begin(), labels.end(), 0U));
  std::printf("points %zu, segments %u with %zu points\n", labels.size(),
              labels.empty() ? 0U : *std::max_element(labels.begin(), labels.end()), labels.size() - unlabelled);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> arguments;
  unsigned threads = 1;
  int normal_neighbours = 0;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--threads") == 0 && i + 1 < argc) {
      threads = static_cast<unsigned>(std::atoi(argv[++i]));
    } else if (std::strcmp(argv[i], "--normal-neighbours") == 0 && i + 1 < argc) {
      normal_neighbours = std::atoi(argv[++i]);
    } else {
      arguments.emplace_back(argv[i]);
    }
  }
  if (arguments.size() < 5 || arguments.size() > 6) {
    std::fprintf(stderr,
                 "usage: bench_pcl_segment SCAN K ANGLE CURVATURE MIN [OUT] [--normal-neighbours N] [--threads N]\n");
    return 2;
  }
  GrowingSettings settings;
  settings.neighbours = std::atoi(arguments[1].c_str());
  settings.angle_deg = std::strtof(arguments[2].c_str(), nullptr);
  settings.curvature = std::strtof(arguments[3].c_str(), nullptr);
  settings.min_points = std::atoi(arguments[4].c_str());
  pcl::console::setVerbosityLevel(pcl::console::L_ERROR);
  try {
    if (normal_neighbours == 0) normal_neighbours = settings.neighbours;
    return run(arguments[0], arguments.size() > 5 ? arguments[5] : "", settings, normal_neighbours, threads);
  } catch (const arris::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_code();
  }
}
