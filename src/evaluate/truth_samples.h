#pragma once
/// @file Truth edges cut into short equal pieces, each known by its midpoint: what recall is counted over.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "evaluate/box_tree.h"
#include "evaluate/truth_edge.h"

namespace arris::evaluate {

/// Pieces at most `step` long. Samples of an edge are consecutive and in order. 40 bytes per sample and 30 for the
/// tree.
class TruthSamples {
 public:
  struct Sample {
    Vec3 position;
    double length = 0.0;  ///< Of the piece it stands for, > 0: edges of length 0 have no samples.
    std::uint32_t edge = 0;
  };

  /// @param step  > 0. Throws ConfigError if that gives more than 2^31 samples.
  TruthSamples(const std::vector<TruthEdge>& edges, double step);

  const std::vector<Sample>& samples() const { return samples_; }
  const BoxTree& tree() const { return tree_; }
  double total_length() const { return total_length_; }

 private:
  std::vector<Sample> samples_;
  BoxTree tree_;
  double total_length_ = 0.0;
};

}  // namespace arris::evaluate
