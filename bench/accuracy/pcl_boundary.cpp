/// @file PCL's boundary estimation.

#include <pcl/features/boundary.h>
#include <pcl/features/normal_3d.h>
#include <pcl/search/kdtree.h>

#include "pcl_cloud.h"

namespace arris::bench {

Labels pcl_boundary(const Cloud& cloud, const BaselineOptions& options) {
  Labels labels;
  if (cloud.empty()) return labels;
  const pcl::PointCloud<pcl::PointXYZ>::Ptr points = to_pcl(cloud);
  pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>);
  pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimate_normals;
  estimate_normals.setInputCloud(points);
  estimate_normals.setSearchMethod(tree);
  estimate_normals.setKSearch(options.neighbours);
  estimate_normals.compute(*normals);
  pcl::PointCloud<pcl::Boundary> boundaries;
  pcl::BoundaryEstimation<pcl::PointXYZ, pcl::Normal, pcl::Boundary> estimate_boundaries;
  estimate_boundaries.setInputCloud(points);
  estimate_boundaries.setInputNormals(normals);
  estimate_boundaries.setSearchMethod(tree);
  estimate_boundaries.setKSearch(options.neighbours);
  estimate_boundaries.setAngleThreshold(static_cast<float>(options.threshold));
  estimate_boundaries.compute(boundaries);
  labels.edge.reserve(cloud.size());
  for (const pcl::Boundary& b : boundaries) labels.edge.push_back(b.boundary_point != 0 ? 1 : 0);
  return labels;
}

}  // namespace arris::bench
