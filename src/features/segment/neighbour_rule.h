#pragma once
/// @file How many neighbours a point has: more where its surroundings are noisy against their spacing.

#include <array>
#include <cstddef>

#include "features/neighbourhood/packed_neighbours.h"

namespace arris {

/// The error of a normal goes with nu / k, nu being noise over spacing: so many neighbours that it stays what it is for
/// kFewestNeighbours of them at nu = kNoiseOfFewest, where planes still hold together.
constexpr std::size_t kFewestNeighbours = 8;
constexpr double kNoiseOfFewest = 0.11;

/// The level of kNeighbourLevels next to that number (in ratio).
std::size_t neighbours_for(double noise_over_spacing);
constexpr std::array<std::size_t, 5> kNeighbourLevels{kFewestNeighbours, 12, 16, 24, 32};

/// Looks at the nearest least() neighbours alone: k neighbours that are all in sight prove that k is right. Immutable.
class NeighbourRule {
 public:
  /// The same number everywhere.
  explicit NeighbourRule(std::size_t neighbours) : least_(neighbours), most_(neighbours) {}
  /// By the local spacing of these neighbours, s^2 = pi d^2 / m, d being the distance of the last of the m. Where they
  /// lie along a line (a scan line), that tells nothing of what the normal rests on: there s^2 is at most kAcross2
  /// times what it is across the line. @param most  a level.
  NeighbourRule(double noise_steps, std::size_t most);

  std::size_t least() const { return least_; }
  std::size_t most() const { return most_; }
  /// @param found  at least least().
  std::size_t wanted(const PackedNeighbours& found) const {
    return least_ == most_ ? least_ : wanted_by_spacing(found);
  }

 private:
  std::size_t wanted_by_spacing(const PackedNeighbours& found) const;

  std::size_t least_, most_;
  double noise2_ = 0.0;  ///< steps^2.
};

}  // namespace arris
