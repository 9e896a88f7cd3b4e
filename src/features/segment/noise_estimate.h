#pragma once
/// @file How noisy a scan is, and how dense where it is dense, from a sample of it.

#include <cstddef>
#include <span>
#include <vector>

#include "core/lattice.h"

namespace arris {

/// At sampled points: noise l0 of the plain plane through kNoiseNeighbours neighbours, and spacing s^2 = 4 pi sqrt(l1
/// l2) / k, the area that each of k points of an ellipse has. Lengths in steps. Not thread-safe.
class NoiseEstimate {
 public:
  /// All points of the scan in one box. Points whose neighbours may lie outside of it are not looked at. O(n log n).
  void add(std::span<const LatticePoint> points, const LatticeBox& box);

  /// What another one has looked at.
  void add(const NoiseEstimate& other) {
    samples_.insert(samples_.end(), other.samples_.begin(), other.samples_.end());
  }

  /// From the first quartile (edges and vegetation aside) of the densest quarter: there noise counts, and there it is
  /// most of what the planes leave. 0 without any.
  double noise() const;
  /// One in a hundred is smaller. 0 without any.
  double least_spacing() const;

 private:
  struct Sample {
    double spacing, noise;
  };
  std::vector<Sample> samples_;
};

constexpr std::size_t kNoiseNeighbours = 12;

}  // namespace arris
