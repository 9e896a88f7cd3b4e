#pragma once
/// @file Points as PCL takes them.

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "baseline.h"

namespace arris::bench {

/// Relative to the first point: PCL's coordinates are float, and world coordinates of a survey have seven digits before
/// the point.
inline pcl::PointCloud<pcl::PointXYZ>::Ptr to_pcl(const Cloud& cloud) {
  pcl::PointCloud<pcl::PointXYZ>::Ptr result(new pcl::PointCloud<pcl::PointXYZ>);
  result->reserve(cloud.size());
  for (const std::array<double, 3>& p : cloud) {
    result->emplace_back(static_cast<float>(p[0] - cloud[0][0]), static_cast<float>(p[1] - cloud[0][1]),
                         static_cast<float>(p[2] - cloud[0][2]));
  }
  return result;
}

}  // namespace arris::bench
