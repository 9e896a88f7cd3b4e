#pragma once
/// @file RapidCheck generators of small labelled clouds.

#include <rapidcheck.h>

#include <vector>

#include "evaluate/labelled_point.h"

namespace arris::evaluate {

/// On a coarse grid, so that many points coincide or lie at exactly the radius; labels from 0 to 3.
inline rc::Gen<LabelledPoint> any_labelled_point() {
  return rc::gen::apply(
      [](int x, int y, int z, int segment, int face) {
        return LabelledPoint{
            {0.25 * x, 0.25 * y, 0.25 * z}, static_cast<std::uint32_t>(segment), static_cast<std::uint32_t>(face)};
      },
      rc::gen::inRange(-12, 13), rc::gen::inRange(-12, 13), rc::gen::inRange(-2, 3), rc::gen::inRange(0, 4),
      rc::gen::inRange(0, 4));
}

inline rc::Gen<std::vector<LabelledPoint>> any_labelled_cloud() {
  return rc::gen::container<std::vector<LabelledPoint>>(any_labelled_point());
}

}  // namespace arris::evaluate
