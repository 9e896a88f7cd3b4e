#pragma once
/// @file Which candidates are in a ball.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "features/neighbourhood/ball_moments.h"

namespace arris {

/// Members (indices of candidates) in ascending order of candidates, in front of `members`, which only grows; returns
/// how many. O(candidates).
template <class T>
std::size_t ball_members(const CandidateSet<T>& candidates, const BallQuery<T>& ball,
                         std::vector<std::uint32_t>& members);

}  // namespace arris
