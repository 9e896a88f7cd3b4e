#pragma once
/// @file How coarse the cells must be that points are counted in.

#include <cstddef>
#include <span>

#include "core/lattice.h"

namespace arris::tiling {

/// The finest level from `first` on at which some of the points, spread over all, take at most max_leaves leaves, as
/// far as hashes tell leaves apart: every set that holds the points needs this level or a coarser one, and counting
/// that begins there is spared the coarsening up to it.
int level_that_fits(std::span<const LatticePoint> points, int first, std::size_t max_leaves);

}  // namespace arris::tiling
