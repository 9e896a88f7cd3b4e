#pragma once
/// @file Peers of other authors, run on the points of one file with the settings that their own documentation gives.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace arris::bench {

/// World coordinates, all finite, in the order of the file.
using Cloud = std::vector<std::array<double, 3>>;

struct BaselineOptions {
  int neighbours = 30;              ///< k, the point itself included, >= 3.
  double threshold = 0.0;           ///< Of the method's own measure; the unit is the method's (see below).
  double spacing = 0.0;             ///< s, the cloud's unit; needed by voronoi_covariance() only.
  double offset_factor = 0.0;       ///< R / s, voronoi_covariance() only.
  double convolution_factor = 0.0;  ///< r / s, voronoi_covariance() only.
};

/// One entry per point of the cloud in each vector.
struct Labels {
  std::vector<std::uint8_t> edge;  ///< 1: the method calls it an edge.
  std::vector<float> score;        ///< The method's measure, larger is surer; empty if the method gives none.
};

/// pcl::NormalEstimation and pcl::BoundaryEstimation over k neighbours; threshold is the azimuth gap in radians (PCL's
/// default is pi / 2). PCL computes in float, so points are handed over relative to the first one.
Labels pcl_boundary(const Cloud& cloud, const BaselineOptions& options);

/// Surface variation l3 / (l1 + l2 + l3), in [0, 1/3], of the covariance of k neighbours, above the threshold:
/// Bazazian, Casas, Ruiz-Hidalgo, "Fast and Robust Edge Extraction in Unorganized Point Clouds", DICTA 2015. 0 where
/// all neighbours coincide. A cloud of fewer than k points uses what there is.
Labels surface_variation(const Cloud& cloud, const BaselineOptions& options);

/// Voronoi covariance measure with offset radius R and convolution radius r, l2 / (l1 + l2 + l3) at or above the
/// threshold: Merigot, Ovsjanikov, Guibas, "Voronoi-Based Curvature and Feature Estimation from Point Clouds", TVCG
/// 2011, as CGAL implements it. Only in builds with CGAL (ARRIS_BENCH_CGAL).
Labels voronoi_covariance(const Cloud& cloud, const BaselineOptions& options);

}  // namespace arris::bench
