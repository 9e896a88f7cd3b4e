#pragma once
/// @file How noisy a scan is against its spacing, from a sample of it, and how many neighbours a normal needs then.

#include <cstddef>
#include <span>
#include <vector>

#include "core/lattice.h"

namespace arris {

/// Noise over spacing at sampled points: nu^2 = l0 / s^2 of the plain plane through kNoiseNeighbours neighbours, with
/// s^2 = 4 pi sqrt(l1 l2) / k, the area that each of k points of an ellipse has. Not thread-safe.
class NoiseEstimate {
 public:
  /// All points of the scan in one box. Points whose neighbours may lie outside of it are not looked at. O(n log n).
  void add(std::span<const LatticePoint> points, const LatticeBox& box);

  /// The first quartile: what the flat quarter of the scan has, edges and vegetation aside. 0 without any.
  double noise_over_spacing() const;

 private:
  std::vector<double> noise_;
};

constexpr std::size_t kNoiseNeighbours = 12;

/// The error of a normal goes with nu / k: so many neighbours that it stays what it is for 8 of them at nu = 0.11, where
/// planes still hold together; 8 to 32.
std::size_t neighbours_for(double noise_over_spacing);

}  // namespace arris
