/// @file A peer of arris segment: CGAL's normals and region growing of planes, everything in memory, one thread.
/// Usage: bench_cgal_segment SCAN K_NORMALS K_GROWTH ANGLE DISTANCE MIN
/// ANGLE in degrees, DISTANCE (from the plane of a region) in data units. Prints points, segments, CPU and wall seconds
/// of each stage, and the peak of resident memory.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing_on_point_set.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/property_map.h>

#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "../stage_clock.h"
#include "core/error.h"
#include "io/point_source.h"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Element = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Elements = std::vector<Element>;
using PointMap = CGAL::First_of_pair_property_map<Element>;
using NormalMap = CGAL::Second_of_pair_property_map<Element>;
using Neighbours = CGAL::Shape_detection::Point_set::K_neighbor_query<Kernel, Elements, PointMap>;
using Plane = CGAL::Shape_detection::Point_set::Least_squares_plane_fit_region<Kernel, Elements, PointMap, NormalMap>;
using Growing = CGAL::Shape_detection::Region_growing<Elements, Neighbours, Plane>;

/// Relative to the offset.
Elements read_elements(const char* scan) {
  const auto source = arris::io::open_point_source(scan);
  const arris::io::SourceInfo& info = source->info();
  Elements elements;
  elements.reserve(info.points);
  for (arris::io::PointBatch batch; source->read(batch, {});) {
    for (std::size_t i = 0; i < batch.count; ++i) {
      elements.emplace_back(
          info.scaled_integers
              ? Kernel::Point_3(batch.ix[i] * info.scale[0], batch.iy[i] * info.scale[1], batch.iz[i] * info.scale[2])
              : Kernel::Point_3(batch.x[i], batch.y[i], batch.z[i]),
          Kernel::Vector_3());
    }
  }
  return elements;
}

int run(char** argv) {
  arris::bench::StageClock clock;
  Elements elements = read_elements(argv[1]);
  clock.end_stage("read");
  CGAL::pca_estimate_normals<CGAL::Sequential_tag>(
      elements, static_cast<unsigned>(std::atoi(argv[2])),
      CGAL::parameters::point_map(PointMap()).normal_map(NormalMap()).geom_traits(Kernel()));
  clock.end_stage("normals");
  Neighbours neighbours(elements, static_cast<std::size_t>(std::atoi(argv[3])), PointMap());
  Plane plane(elements, std::atof(argv[5]), std::atof(argv[4]), static_cast<std::size_t>(std::atoi(argv[6])),
              PointMap(), NormalMap());
  Growing growing(elements, neighbours, plane);
  std::vector<std::vector<std::size_t>> segments;
  growing.detect(std::back_inserter(segments));
  clock.end_stage("grow");
  std::size_t inside = 0;
  for (const auto& segment : segments) inside += segment.size();
  std::printf("points %zu, segments %zu with %zu points\n", elements.size(), segments.size(), inside);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 7) {
    std::fprintf(stderr, "usage: bench_cgal_segment SCAN K_NORMALS K_GROWTH ANGLE DISTANCE MIN\n");
    return 2;
  }
  try {
    return run(argv);
  } catch (const arris::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_code();
  }
}
