/// @file CGAL's Voronoi covariance measure.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/vcm_estimate_edges.h>
#include <CGAL/vcm_estimate_normals.h>

#include <stdexcept>

#include "baseline.h"

namespace arris::bench {

Labels voronoi_covariance(const Cloud& cloud, const BaselineOptions& options) {
  if (!(options.spacing > 0.0)) throw std::runtime_error("cgal-vcm needs --spacing above 0");
  Labels labels;
  if (cloud.empty()) return labels;
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> points;
  points.reserve(cloud.size());
  // In spacings and relative to the first point: sums of covariances lose digits far from the origin.
  for (const std::array<double, 3>& p : cloud) {
    points.emplace_back((p[0] - cloud[0][0]) / options.spacing, (p[1] - cloud[0][1]) / options.spacing,
                        (p[2] - cloud[0][2]) / options.spacing);
  }
  std::vector<std::array<double, 6>> covariances;
  CGAL::compute_vcm(points, covariances, options.offset_factor, options.convolution_factor);
  for (std::array<double, 6>& covariance : covariances) {
    std::array<double, 3> eigenvalues{};
    const bool solved =
        CGAL::Default_diagonalize_traits<double, 3>::diagonalize_selfadjoint_covariance_matrix(covariance, eigenvalues);
    const double sum = eigenvalues[0] + eigenvalues[1] + eigenvalues[2];
    labels.score.push_back(solved && sum > 0.0 ? static_cast<float>(eigenvalues[1] / sum) : 0.0F);
    labels.edge.push_back(CGAL::vcm_is_on_feature_edge(covariance, options.threshold) ? 1 : 0);
  }
  return labels;
}

}  // namespace arris::bench
