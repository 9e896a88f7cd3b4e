#pragma once
/// @file Planes of labelled points, for tests of what follows from them.

#include <cstdint>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "features/segment/segment_plane.h"

namespace arris::test {

/// Planes of labels 1 .. max by least squares; `spacing` steps for all.
std::vector<SegmentPlane> planes_of(std::span<const LatticePoint> positions, const std::vector<std::uint32_t>& labels,
                                    double spacing);

}  // namespace arris::test
