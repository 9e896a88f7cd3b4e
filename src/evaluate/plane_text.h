#pragma once
/// @file Judged planes as parts of the text of a segmentation. Private to evaluate.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "evaluate/plane_comparison.h"

namespace arris::evaluate {

/// One object; undefined figures are null.
nlohmann::ordered_json planes_json(const PlaneComparison& planes);
/// Names and cells of a line of CSV, all with the prefix plane_; undefined cells are empty.
std::vector<std::pair<std::string, std::string>> planes_cells(const PlaneComparison& planes);
/// A table of several lines; "-" where undefined.
std::string planes_table(const PlaneComparison& planes);

}  // namespace arris::evaluate
