#pragma once
/// @file Truth edges cut into short equal pieces, each known by its midpoint: what recall is counted over.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "evaluate/box_tree.h"
#include "evaluate/truth_edge.h"

namespace arris::evaluate {

/// Pieces at most `step` long. Samples of an edge are consecutive and in order. 40 bytes per sample and 34 for the
/// trees.
class TruthSamples {
 public:
  struct Sample {
    Vec3 position;
    double length = 0.0;  ///< Of the piece it stands for, > 0: edges of length 0 have no samples.
    std::uint32_t edge = 0;
  };

  /// @param step  in units of the edge, > 0. @param units  of each edge, data units, > 0. Throws ConfigError if that
  /// gives more than 2^31 samples.
  TruthSamples(const std::vector<TruthEdge>& edges, double step, std::vector<double> units);

  const std::vector<Sample>& samples() const { return samples_; }
  double unit_of(const Sample& sample) const { return units_[sample.edge]; }
  double total_length() const { return total_length_; }

  /// Calls visit(i) for a superset of the samples within `limit` of their own units of p.
  template <class Visit>
  void search(const Vec3& p, double limit, const Visit& visit) const {
    for (const Group& group : groups_) {
      double squared_limit = limit * group.longest_unit * (limit * group.longest_unit);
      group.tree.search(p, squared_limit, [&](std::uint32_t item) { visit(group.samples[item]); });
    }
  }

 private:
  struct Group {
    std::vector<std::uint32_t> samples;
    BoxTree tree;
    double longest_unit = 1.0;
  };

  std::vector<Sample> samples_;
  std::vector<double> units_;
  std::vector<Group> groups_;
  double total_length_ = 0.0;
};

}  // namespace arris::evaluate
