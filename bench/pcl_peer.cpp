/// @file The peer: PCL's normals and boundary estimation on the points of a LAS or PLY file, everything in memory.
/// Usage: bench_pcl_peer SCAN [threads]. Prints CPU seconds per stage, reading included.

#include <pcl/features/boundary.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>

#include "io/point_source.h"

namespace {

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const int threads = argc > 2 ? std::atoi(argv[2]) : 1;
  const auto source = arris::io::open_point_source(argv[1]);
  const arris::io::SourceInfo& info = source->info();
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  arris::io::PointBatch batch;
  while (source->read(batch, {})) {
    for (std::size_t i = 0; i < batch.count; ++i) {
      // Relative to the offset: PCL's coordinates are float.
      if (info.scaled_integers) {
        cloud->emplace_back(static_cast<float>(batch.ix[i] * info.scale[0]),
                            static_cast<float>(batch.iy[i] * info.scale[1]),
                            static_cast<float>(batch.iz[i] * info.scale[2]));
      } else {
        cloud->emplace_back(static_cast<float>(batch.x[i]), static_cast<float>(batch.y[i]),
                            static_cast<float>(batch.z[i]));
      }
    }
  }
  const double read = cpu_seconds();
  pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>);
  pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimate_normals(static_cast<unsigned>(threads));
  estimate_normals.setInputCloud(cloud);
  estimate_normals.setSearchMethod(tree);
  estimate_normals.setKSearch(16);
  estimate_normals.compute(*normals);
  const double with_normals = cpu_seconds();
  pcl::PointCloud<pcl::Boundary> boundaries;
  pcl::BoundaryEstimation<pcl::PointXYZ, pcl::Normal, pcl::Boundary> estimate_boundaries;
  estimate_boundaries.setInputCloud(cloud);
  estimate_boundaries.setInputNormals(normals);
  estimate_boundaries.setSearchMethod(tree);
  estimate_boundaries.setKSearch(30);
  estimate_boundaries.compute(boundaries);
  const double all = cpu_seconds();
  std::size_t found = 0;
  for (const pcl::Boundary& b : boundaries) found += b.boundary_point != 0;
  const double millions = static_cast<double>(cloud->size()) / 1e6;
  std::printf("points %zu  boundary %zu  CPU s: read %.2f, normals %.2f, boundary %.2f  = %.2f M points per CPU s\n",
              cloud->size(), found, read, with_normals - read, all - with_normals, millions / all);
  return 0;
}
