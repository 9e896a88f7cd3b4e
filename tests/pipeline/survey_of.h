#pragma once
/// @file The survey of a cloud in memory.

#include <vector>

#include "tiling/survey.h"

namespace arris::test {

/// Steps of a millimetre.
inline tiling::Survey survey_of(const std::vector<LatticePoint>& points) {
  tiling::Survey survey;
  survey.lattice = {0.001, {0.0, 0.0, 0.0}};
  survey.add(points, std::vector<tiling::Mapped>(points.size(), tiling::Mapped::kOk));
  survey.finish();
  return survey;
}

}  // namespace arris::test
