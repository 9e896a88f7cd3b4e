#pragma once
/// @file Chooses the lattice of a run from the inputs.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/lattice.h"
#include "io/point_source.h"
#include "tiling/axis_range.h"

namespace arris::tiling {

/// Step of the lattice, in data units, where the inputs do not suggest one.
constexpr double kDefaultLatticeStep = 0.0001;

/// How many times `fine` goes into `coarse`, if that is a whole number (to 1e-12, so that no int32 is moved by a
/// hundredth of a step); 0 if not, or if it is beyond 2^31.
std::int64_t whole_multiple(double coarse, double fine);

/// Laws: (1) the lattice depends on the scales and offsets of the inputs and on the set of their points, not on any
/// order. (2) If all inputs have scaled integers of one scale triple whose axes are whole multiples of the finest, and
/// no step is requested, the step is that finest scale and stored integers map exactly; the origin is the
/// lexicographically smallest offset, moved by a multiple of 2^16 steps only along axes that would not fit int32
/// otherwise. (3) Otherwise the step is the one requested or kDefaultLatticeStep, and the origin per axis the world
/// multiple of 2^16 steps below the middle of the points. (4) If an axis is longer than 2^31 steps, points outside of
/// the best window of that length are left out as outliers when they are fewer than one in a thousand; if there are
/// more, the step grows by powers of ten.
class LatticeChoice {
 public:
  /// @param requested_step  0: choose. Throws ConfigError if it is negative, not finite, or below 1e-9.
  LatticeChoice(const std::vector<io::SourceInfo>& sources, double requested_step);

  /// True if every batch must be shown to add() before lattice() is asked.
  bool needs_points() const { return needs_points_; }
  void add(const io::PointBatch& batch, std::size_t source_index);
  Lattice lattice() const;

 private:
  std::optional<Lattice> with_step(double step) const;

  std::vector<io::SourceInfo> sources_;
  bool exact_ = false;
  bool needs_points_ = true;
  Lattice base_;
  std::vector<AxisRange> ranges_;
};

}  // namespace arris::tiling
