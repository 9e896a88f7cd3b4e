#pragma once
/// @file PCL's normals and region growing (Rabbani et al. 2006) on the points of a scan.

#include <pcl/features/normal_3d_omp.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/region_growing.h>

#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "io/point_source.h"

namespace arris::bench {

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;
using PclNormals = pcl::PointCloud<pcl::Normal>;
using PclSearch = pcl::search::Search<pcl::PointXYZ>;

struct GrowingSettings {
  int neighbours = 30;      ///< Of normals and of growth.
  float angle_deg = 3.0F;   ///< Between normals of neighbours.
  float curvature = 0.05F;  ///< Points of at most so much go on growing.
  int min_points = 20;      ///< Smaller segments are none.
};

/// Relative to the scan's offset: PCL's coordinates are float.
inline PclCloud::Ptr read_cloud(const std::string& path) {
  const auto source = io::open_point_source(path);
  PclCloud::Ptr cloud(new PclCloud);
  cloud->reserve(source->info().points);
  for (io::PointBatch batch; source->read(batch, {});) {
    for (std::size_t i = 0; i < batch.count; ++i) {
      const auto at = [&](std::size_t axis) {
        return static_cast<float>(io::world_coordinate(source->info(), batch, i, axis) - source->info().offset[axis]);
      };
      cloud->emplace_back(at(0), at(1), at(2));
    }
  }
  return cloud;
}

inline PclNormals::Ptr estimate_normals(const PclCloud::Ptr& cloud, const PclSearch::Ptr& tree, int neighbours,
                                        unsigned threads) {
  PclNormals::Ptr normals(new PclNormals);
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation(threads);
  estimation.setInputCloud(cloud);
  estimation.setSearchMethod(tree);
  estimation.setKSearch(neighbours);
  estimation.compute(*normals);
  return normals;
}

/// The segment of every point from 1, or 0.
inline std::vector<std::uint32_t> grow_regions(const PclCloud::Ptr& cloud, const PclSearch::Ptr& tree,
                                               const PclNormals::Ptr& normals, const GrowingSettings& settings) {
  pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal> growing;
  growing.setMinClusterSize(settings.min_points);
  growing.setSearchMethod(tree);
  growing.setNumberOfNeighbours(static_cast<unsigned>(settings.neighbours));
  growing.setInputCloud(cloud);
  growing.setInputNormals(normals);
  growing.setSmoothnessThreshold(settings.angle_deg * std::numbers::pi_v<float> / 180.0F);
  growing.setCurvatureThreshold(settings.curvature);
  std::vector<pcl::PointIndices> segments;
  growing.extract(segments);
  std::vector<std::uint32_t> labels(cloud->size(), 0);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    for (const int i : segments[s].indices) labels[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(s + 1);
  }
  return labels;
}

}  // namespace arris::bench
