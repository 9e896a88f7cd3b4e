#pragma once
/// @file Numbers of groups of labels, in the order of the smallest ids.

#include <cstdint>
#include <span>
#include <vector>

#include "merge/point_labels.h"

namespace arris::merge {

/// Labels become the numbers of the groups they are in: 1 .. n in the order of the smallest ids that are in them.
/// O(labels + n log n), in parallel; 4 bytes per label in use and per group.
/// @param group_of  of label i at [i - 1]: 1 .. groups, or 0: the label goes. Labels are no more than its size.
/// @return the groups that some id is in, by their numbers.
std::vector<std::uint32_t> number_groups(std::span<const std::uint32_t> group_of, std::uint32_t groups,
                                         PointLabels& labels);

}  // namespace arris::merge
