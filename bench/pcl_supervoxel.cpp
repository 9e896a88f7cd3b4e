/// @file The peer of arris supervoxel: PCL's supervoxels (Papon et al. 2013), everything in memory.
/// Usage: bench_pcl_supervoxel SCAN R_VOXEL R_SEED [OUT] [--refine N]
/// Lengths in data units. Prints points, supervoxels, CPU and wall seconds of each stage, and the peak of resident
/// memory. OUT (.las, .ply): every point of the scan with its SupervoxelId, for arris evaluate. --refine: that many
/// passes of refineSupervoxels(). Weights are PCL's own: spatial 0.4, normal 1.0, colour 0.1, or 0 if there is none.

#include <pcl/console/print.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/supervoxel_clustering.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/input_file.h"
#include "io/record_reader.h"
#include "label_output.h"
#include "stage_clock.h"

namespace {

using Point = pcl::PointXYZRGBA;
using Cloud = pcl::PointCloud<Point>;

/// Where the origin that PCL sees lies, from the scan's offset: PCL turns normals towards it, so it must not lie in the
/// plane of a face, as the corner of a scene does.
constexpr double kOrigin[3] = {-1.1, -2.3, -3.7};

/// 16-bit colours of LAS, or those of PLY as they are, as PCL's bytes.
class ColourReader {
 public:
  ColourReader(const arris::io::SourceInfo& info)
      : reader_(arris::io::make_record_reader(arris::io::InputFile(info.path), info)),
        values_(reader_->columns().size()) {
    const char* const names[3] = {"red", "green", "blue"};
    for (int c = 0; c < 3; ++c) columns_[c] = reader_->find(names[c]);
  }
  bool any() const { return columns_[0] >= 0 && columns_[1] >= 0 && columns_[2] >= 0; }
  void read(std::span<const std::byte> record, Point& point) {
    reader_->read(record, values_);
    std::uint8_t* const bytes[3] = {&point.r, &point.g, &point.b};
    for (int c = 0; c < 3; ++c) {
      const bool wide = reader_->columns()[columns_[c]].type != arris::io::ScalarType::kUint8;
      *bytes[c] = static_cast<std::uint8_t>(values_[columns_[c]] / (wide ? 257.0 : 1.0));
    }
  }

 private:
  std::unique_ptr<arris::io::RecordReader> reader_;
  std::vector<double> values_;
  int columns_[3] = {-1, -1, -1};
};

Cloud::Ptr read_cloud(const std::string& path, bool& colours) {
  const auto source = arris::io::open_point_source(path);
  ColourReader colour(source->info());
  colours = colour.any();
  Cloud::Ptr cloud(new Cloud);
  cloud->reserve(source->info().points);
  double origin[3];
  for (std::size_t axis = 0; axis < 3; ++axis) origin[axis] = source->info().offset[axis] + kOrigin[axis];
  arris::io::ReadOptions options;
  options.records = colours;
  for (arris::io::PointBatch batch; source->read(batch, options);) {
    for (std::size_t i = 0; i < batch.count; ++i) {
      const auto at = [&](std::size_t axis) {
        return static_cast<float>(arris::io::world_coordinate(source->info(), batch, i, axis) - origin[axis]);
      };
      Point point;
      point.x = at(0);
      point.y = at(1);
      point.z = at(2);
      point.r = point.g = point.b = 0;
      if (colours) {
        const std::size_t begin = batch.record_begin[i];
        colour.read({batch.records.data() + begin, batch.record_begin[i + 1] - begin}, point);
      }
      cloud->push_back(point);
    }
  }
  return cloud;
}

int run(const std::string& scan, float voxel, float seed, const std::string& out, int refinements) {
  arris::bench::StageClock clock;
  bool colours = false;
  const Cloud::Ptr cloud = read_cloud(scan, colours);
  clock.end_stage("read");
  pcl::SupervoxelClustering<Point> clustering(voxel, seed);
  clustering.setUseSingleCameraTransform(false);
  clustering.setInputCloud(cloud);
  clustering.setColorImportance(colours ? 0.1F : 0.0F);
  clustering.setSpatialImportance(0.4F);
  clustering.setNormalImportance(1.0F);
  std::map<std::uint32_t, pcl::Supervoxel<Point>::Ptr> supervoxels;
  clustering.extract(supervoxels);
  clock.end_stage("cluster");
  if (refinements > 0) {
    clustering.refineSupervoxels(refinements, supervoxels);
    clock.end_stage("refine");
  }
  const auto labels = clustering.getLabeledCloud();
  clock.end_stage("label");
  if (!out.empty()) {
    std::vector<std::uint32_t> numbers;
    numbers.reserve(labels->size());
    for (const pcl::PointXYZL& point : *labels) numbers.push_back(point.label);
    arris::bench::write_labels(scan, out, {"SupervoxelId", arris::ColumnType::kUint32, "supervoxel; 0: none"}, numbers);
    clock.end_stage("write");
  }
  std::printf("points %zu, supervoxels %zu, colour %s\n", cloud->size(), supervoxels.size(), colours ? "yes" : "no");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> arguments;
  int refinements = 0;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--refine") == 0 && i + 1 < argc) {
      refinements = std::atoi(argv[++i]);
    } else {
      arguments.emplace_back(argv[i]);
    }
  }
  if (arguments.size() < 3 || arguments.size() > 4) {
    std::fprintf(stderr, "usage: bench_pcl_supervoxel SCAN R_VOXEL R_SEED [OUT] [--refine N]\n");
    return 2;
  }
  pcl::console::setVerbosityLevel(pcl::console::L_ERROR);
  try {
    return run(arguments[0], std::strtof(arguments[1].c_str(), nullptr), std::strtof(arguments[2].c_str(), nullptr),
               arguments.size() > 3 ? arguments[3] : "", refinements);
  } catch (const arris::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_code();
  }
}
