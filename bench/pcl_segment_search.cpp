/// @file The best that PCL's region growing can do: all settings of a grid, judged with a look at the truth.
/// Usage: bench_pcl_segment_search SPACING MIN_AREA SCAN...
/// Scans have the true surfaces in the column FaceId. For every setting (K, ANGLE, CURVATURE, MIN as bench_pcl_segment
/// takes them) prints a line with the mean over the scans of F, the harmonic mean of completeness and correctness of
/// the planes of MIN_AREA or more (evaluate/plane_comparison.h). The grid is wider than what is usual in papers.

#include <pcl/console/print.h>

#include <cstdio>
#include <cstdlib>
#include <map>

#include "core/error.h"
#include "evaluate/plane_comparison.h"
#include "evaluate/segmentation_comparison.h"
#include "io/attribute_reader.h"
#include "pcl_region_growing.h"

namespace {

using namespace arris::bench;

constexpr int kNeighbours[] = {8, 12, 16, 20, 24, 30};
constexpr float kAnglesDeg[] = {3.0F, 5.0F, 7.5F, 10.0F, 12.5F, 15.0F};
constexpr float kCurvatures[] = {0.02F, 0.05F, 0.1F, 0.2F};
constexpr int kMinPoints[] = {10, 20};

std::vector<std::uint32_t> read_faces(const std::string& path) {
  const auto source = arris::io::open_point_source(path);
  arris::io::AttributeReader attributes(path, {std::string(arris::evaluate::kFaceColumn)});
  if (!attributes.has(0)) throw arris::ConfigError(path + " has no column FaceId; make it by arris synth --labels");
  arris::io::ReadOptions options;
  options.records = true;
  std::vector<std::uint32_t> faces;
  std::vector<double> values;
  for (arris::io::PointBatch batch; source->read(batch, options);) {
    attributes.read(batch, 0, values);
    for (const double value : values) faces.push_back(static_cast<std::uint32_t>(value));
  }
  return faces;
}

double judge(const std::vector<std::uint32_t>& faces, const std::vector<std::uint32_t>& labels,
             const arris::evaluate::PlaneOptions& options) {
  std::vector<arris::evaluate::LabelledPoint> points(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) points[i] = {{}, labels[i], faces[i]};
  const auto large = compare_planes(points, options).large;
  const double complete = large.completeness.value_or(0.0), correct = large.correctness.value_or(0.0);
  return complete + correct > 0.0 ? 2.0 * complete * correct / (complete + correct) : 0.0;
}

struct Scan {
  PclCloud::Ptr cloud;
  std::vector<std::uint32_t> faces;
};

int run(const std::vector<std::string>& paths, const arris::evaluate::PlaneOptions& options) {
  std::vector<Scan> scans;
  for (const std::string& path : paths) scans.push_back({read_cloud(path), read_faces(path)});
  for (const int k : kNeighbours) {
    std::map<std::vector<float>, double> sums;  // Of F, by the other settings.
    for (const Scan& scan : scans) {
      const PclSearch::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>);
      const PclNormals::Ptr normals = estimate_normals(scan.cloud, tree, k, 1);
      for (const float angle_deg : kAnglesDeg) {
        for (const float curvature : kCurvatures) {
          for (const int least : kMinPoints) {
            const auto labels = grow_regions(scan.cloud, tree, normals, {k, angle_deg, curvature, least});
            sums[{angle_deg, curvature, static_cast<float>(least)}] += judge(scan.faces, labels, options);
          }
        }
      }
    }
    for (const auto& [other, sum] : sums) {
      std::printf("%d %g %g %g %.6f\n", k, other[0], other[1], other[2], sum / static_cast<double>(scans.size()));
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: bench_pcl_segment_search SPACING MIN_AREA SCAN...\n");
    return 2;
  }
  pcl::console::setVerbosityLevel(pcl::console::L_ERROR);
  try {
    return run({argv + 3, argv + argc}, {std::strtod(argv[1], nullptr), std::strtod(argv[2], nullptr)});
  } catch (const arris::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_code();
  }
}
