#pragma once
/// @file LAS files of any version, point format and oddity for property tests (within rc::check).

#include <string>

#include "las_builder.h"

namespace arris::test {

/// Extra bytes with right, wrong and no descriptions, VLRs, EVLRs, gaps, longer headers. The header counts no returns
/// and has no bounds.
LasPlan random_plan();

/// The file of a plan with a header that is true in all that follows from its points, and arbitrary in all that does
/// not: identifiers, dates, reserved bytes, waveforms, bytes behind the last structure.
std::string random_true_las(const LasPlan& plan);

}  // namespace arris::test
