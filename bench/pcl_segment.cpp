/// @file The peer of arris segment: PCL's normals and region growing (Rabbani et al. 2006), everything in memory.
/// Usage: bench_pcl_segment SCAN K ANGLE CURVATURE MIN [OUT] [--threads N]
/// K neighbours of normals and of growth; ANGLE in degrees between normals of neighbours; points of at most CURVATURE
/// grow; segments below MIN points are none. Prints points, segments, CPU and wall seconds of each stage, and the peak
/// of resident memory. OUT (.las, .ply): every point of the scan with its SegmentId, for arris evaluate. --threads: of
/// the normals (default 1); growth has one.

#include <pcl/console/print.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/region_growing.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/point_source.h"
#include "label_output.h"
#include "stage_clock.h"

namespace {

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;

struct Settings {
  int neighbours = 30;
  float angle_deg = 3.0F;
  float curvature = 0.05F;
  int min_points = 20;
  unsigned threads = 1;
};

/// Relative to the scan's offset: PCL's coordinates are float.
Cloud::Ptr read_cloud(const std::string& path) {
  const auto source = arris::io::open_point_source(path);
  Cloud::Ptr cloud(new Cloud);
  cloud->reserve(source->info().points);
  for (arris::io::PointBatch batch; source->read(batch, {});) {
    for (std::size_t i = 0; i < batch.count; ++i) {
      const auto at = [&](std::size_t axis) {
        return static_cast<float>(arris::io::world_coordinate(source->info(), batch, i, axis) -
                                  source->info().offset[axis]);
      };
      cloud->emplace_back(at(0), at(1), at(2));
    }
  }
  return cloud;
}

int run(const std::string& scan, const std::string& out, const Settings& settings) {
  arris::bench::StageClock clock;
  const Cloud::Ptr cloud = read_cloud(scan);
  clock.end_stage("read");
  const pcl::search::Search<Point>::Ptr tree(new pcl::search::KdTree<Point>);
  const pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  pcl::NormalEstimationOMP<Point, pcl::Normal> estimation(settings.threads);
  estimation.setInputCloud(cloud);
  estimation.setSearchMethod(tree);
  estimation.setKSearch(settings.neighbours);
  estimation.compute(*normals);
  clock.end_stage("normals");
  pcl::RegionGrowing<Point, pcl::Normal> growing;
  growing.setMinClusterSize(settings.min_points);
  growing.setSearchMethod(tree);
  growing.setNumberOfNeighbours(static_cast<unsigned>(settings.neighbours));
  growing.setInputCloud(cloud);
  growing.setInputNormals(normals);
  growing.setSmoothnessThreshold(settings.angle_deg * std::numbers::pi_v<float> / 180.0F);
  growing.setCurvatureThreshold(settings.curvature);
  std::vector<pcl::PointIndices> segments;
  growing.extract(segments);
  clock.end_stage("grow");
  std::vector<std::uint32_t> labels(cloud->size(), 0);
  std::size_t labelled = 0;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    for (const int i : segments[s].indices) labels[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(s + 1);
    labelled += segments[s].indices.size();
  }
  if (!out.empty()) {
    arris::bench::write_labels(scan, out, {"SegmentId", arris::ColumnType::kUint32, "segment; 0: none"}, labels);
    clock.end_stage("write");
  }
  std::printf("points %zu, segments %zu with %zu points\n", cloud->size(), segments.size(), labelled);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> arguments;
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--threads") == 0 && i + 1 < argc) {
      settings.threads = static_cast<unsigned>(std::atoi(argv[++i]));
    } else {
      arguments.emplace_back(argv[i]);
    }
  }
  if (arguments.size() < 5 || arguments.size() > 6) {
    std::fprintf(stderr, "usage: bench_pcl_segment SCAN K ANGLE CURVATURE MIN [OUT] [--threads N]\n");
    return 2;
  }
  settings.neighbours = std::atoi(arguments[1].c_str());
  settings.angle_deg = std::strtof(arguments[2].c_str(), nullptr);
  settings.curvature = std::strtof(arguments[3].c_str(), nullptr);
  settings.min_points = std::atoi(arguments[4].c_str());
  pcl::console::setVerbosityLevel(pcl::console::L_ERROR);
  try {
    return run(arguments[0], arguments.size() > 5 ? arguments[5] : "", settings);
  } catch (const arris::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_code();
  }
}
