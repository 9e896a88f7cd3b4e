#pragma once
/// @file A scene's points as independent units that can be made in any order. Private to synth.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/point_writer.h"

namespace arris::synth {

/// The points of a scene are those of unit 0, unit 1, ... Every unit depends on the seed and its own index only, so the
/// cut into blocks and the number of threads cannot matter. Immutable after construction: safe to use from several
/// threads.
class PointUnits {
 public:
  virtual ~PointUnits() = default;
  virtual std::uint64_t count() const = 0;
  /// About the most points that one unit has.
  virtual std::size_t unit_points() const = 0;
  /// Expected number of points of all units.
  virtual double expected_points() const = 0;
  /// Appends the points of units [begin, end) to `out`, in scene coordinates.
  virtual void make(std::uint64_t begin, std::uint64_t end, std::vector<io::FreshPoint>& out) const = 0;
};

/// How points are laid on faces; header of scene.h describes each.
enum class Sampling : std::uint8_t { kGrid, kJittered, kRandom, kGradient, kScan, kPoisson };

}  // namespace arris::synth
