#pragma once
/// @file An evaluation as text for people and as JSON for programs.

#include <string>

#include "evaluate/contour_evaluation.h"

namespace arris::evaluate {

/// One JSON object, indented, ending in a newline; shares and lengths as numbers, undefined ones as null. Keys are
/// stable.
std::string to_json(const ContourEvaluation& evaluation);

/// One line per tolerance under a line of names, separated by commas; undefined values are empty. Columns may be added
/// at the end.
std::string to_csv(const ContourEvaluation& evaluation);

/// A table with one line per tolerance, recall per kind, and the distances of the whole sets; "-" where undefined.
std::string to_table(const ContourEvaluation& evaluation);

}  // namespace arris::evaluate
