#pragma once
/// @file A readable, serial, quadratic form of the method to compare against: no tree, no batches, no rejection, no
/// tiles.

#include "features/liu/liu_method.h"

namespace arris::test {

/// What extract_liu must return for a tile that covers everything. Shares with it only the closed-form numerics
/// (eigenvalues, angles, entropy of one neighbourhood, fixed point), which have tests of their own.
TileContours reference_liu(const TilePoints& tile, const Lattice& lattice, const LiuParameters& parameters);

}  // namespace arris::test
