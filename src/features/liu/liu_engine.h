#pragma once
/// @file extract_liu with its internal switches, for tests and benchmarks.

#include <cstdint>
#include <vector>

#include "features/liu/liu_method.h"
#include "features/liu/liu_settings.h"

namespace arris {

/// As extract_liu. Law: `switches` change nothing but the time.
/// @param wanted  One entry per position, non-zero for queries; null: the core points.
TileContours extract_liu_with(const TilePoints& tile, const Lattice& lattice, const LiuParameters& parameters,
                              const std::vector<std::uint8_t>* wanted, const LiuSwitches& switches);

}  // namespace arris
