#pragma once
/// @file One 32-bit label for every point of the scan, in memory.

#include <cstdint>

#include "core/pages.h"

namespace arris::merge {

/// Indexed by global id; 0: none. Different ids may be written from different threads.
using PointLabels = PageVector<std::uint32_t>;
constexpr std::uint64_t kLabelBytesPerPoint = 4;

}  // namespace arris::merge
