#pragma once
/// @file Products of the candidates' coordinates, made once for the sums of many balls.

#include <cstddef>
#include <cstdint>

#include "core/pages.h"

namespace arris {

/// Relative to the candidates' origin, so that balls around different centres share them. Sums of 32-bit integers are
/// exact where those of floats, which stop at 2^24, are not.
struct CandidateProducts {
  PageVector<std::int32_t> xx, xy, xz, yy, yz, zz;
  bool exact = false;  ///< They are there, and no sum over all candidates overflows a lane.
  bool whole = false;  ///< Nor does the sum of all lanes.

  /// Of `count` candidates, none of whose coordinates is more than `farthest` from 0. Arrays are padded as in
  /// CandidateSet, with anything. Leaves them out, with `exact` false, where a sum might overflow.
  void make(const PageVector<float>& x, const PageVector<float>& y, const PageVector<float>& z, std::size_t count,
            double farthest);
};

}  // namespace arris
