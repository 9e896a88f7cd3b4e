#pragma once
/// @file Boxes of lattice positions.

#include <cstdint>

namespace arris {

/// A closed box of lattice positions, both ends included.
struct ClosedBox {
  std::int32_t min[3];
  std::int32_t max[3];
};

}  // namespace arris
