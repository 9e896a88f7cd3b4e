#pragma once
/// @file Compare-exchanges that bring the value of one rank to its place, whatever the values are.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace arris {

/// Each puts the smaller of the values at [0] and [1] to [0], the greater to [1]. After all of them the value at `rank`
/// is the one that sorting would put there: Batcher's merge exchange without what that place does not depend on.
/// @param n  values, at most 255. @param rank  < n.
std::vector<std::array<std::uint8_t, 2>> selection_network(std::size_t n, std::size_t rank);

}  // namespace arris
