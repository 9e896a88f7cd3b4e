#pragma once
/// @file Where a scene is put in the world: a rotation drawn from the seed, then a shift. Private to synth.

#include <array>
#include <cstdint>

#include "evaluate/truth_edge.h"
#include "io/point_writer.h"
#include "synth/face.h"

namespace arris::synth {

class Placement {
 public:
  /// Without rotation the axes stay exactly as they are.
  Placement(bool rotate, const Vec3& shift, std::uint64_t seed);

  Vec3 apply(const Vec3& p) const { return turn(p) + shift_; }
  void apply(io::FreshPoint& point) const;
  evaluate::TruthEdge apply(const evaluate::TruthEdge& edge) const;
  /// The box of the eight moved corners.
  Box3 apply(const Box3& box) const;
  Vec3 undo(const Vec3& p) const;

 private:
  Vec3 turn(const Vec3& p) const { return rotate_ ? Vec3{dot(rows_[0], p), dot(rows_[1], p), dot(rows_[2], p)} : p; }

  bool rotate_;
  Vec3 shift_;
  std::array<Vec3, 3> rows_;
};

}  // namespace arris::synth
