#pragma once
/// @file The survey of a cloud in memory.

#include <cstddef>
#include <vector>

#include "tiling/survey.h"

namespace arris::test {

/// Steps of half a unit.
inline tiling::Survey survey_of(const std::vector<LatticePoint>& points, std::size_t max_leaves = 8192) {
  tiling::Survey survey;
  survey.lattice.step = 0.5;
  survey.counts = tiling::CellCounts(0, max_leaves);
  const std::vector<tiling::Mapped> outcome(points.size(), tiling::Mapped::kOk);
  survey.add(points, outcome);
  survey.finish();
  return survey;
}

}  // namespace arris::test
