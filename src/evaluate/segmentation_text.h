#pragma once
/// @file The comparison of a segmentation with the truth as text, for people and for programs.

#include <string>

#include "evaluate/segmentation_comparison.h"

namespace arris::evaluate {

/// One object; undefined figures are null.
std::string to_json(const SegmentationComparison& comparison);
/// A line of names and a line per tolerance, which all repeat what does not depend on the tolerance; undefined cells
/// are empty.
std::string to_csv(const SegmentationComparison& comparison);
/// Figures of the overlaps, and a line per tolerance of the boundaries; "-" where undefined.
std::string to_table(const SegmentationComparison& comparison);

}  // namespace arris::evaluate
