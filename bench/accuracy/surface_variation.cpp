/// @file The threshold on the smallest eigenvalue's share.

#include <pcl/kdtree/kdtree_flann.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "pcl_cloud.h"

namespace arris::bench {
namespace {

double smallest_share(const Cloud& cloud, const pcl::Indices& neighbours) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const int n : neighbours) mean += Eigen::Map<const Eigen::Vector3d>(cloud[n].data());
  mean /= static_cast<double>(neighbours.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const int n : neighbours) {
    const Eigen::Vector3d d = Eigen::Map<const Eigen::Vector3d>(cloud[n].data()) - mean;
    covariance += d * d.transpose();
  }
  const double trace = covariance.trace();
  if (!(trace > 0.0)) return 0.0;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  return std::max(0.0, solver.eigenvalues()[0]) / trace;  // Rounding may bring a plane's smallest below zero.
}

}  // namespace

Labels surface_variation(const Cloud& cloud, const BaselineOptions& options) {
  Labels labels;
  if (cloud.empty()) return labels;
  const pcl::PointCloud<pcl::PointXYZ>::Ptr points = to_pcl(cloud);
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(points);
  pcl::Indices neighbours;
  std::vector<float> squared_distances;
  for (const pcl::PointXYZ& p : *points) {
    tree.nearestKSearch(p, options.neighbours, neighbours, squared_distances);
    const double share = smallest_share(cloud, neighbours);
    labels.score.push_back(static_cast<float>(share));
    labels.edge.push_back(share > options.threshold ? 1 : 0);
  }
  return labels;
}

}  // namespace arris::bench
