#pragma once
/// @file What runs say beforehand of their memory and temporary files, against what they then take.

#include <cstdint>
#include <string>
#include <vector>

namespace arris::test {

/// Of predicted over measured.
struct PredictionBounds {
  double least, most;
};

/// Runs every command on a simulated town of about so many points, with each budget.
void expect_predictions(std::uint64_t points, const std::vector<std::string>& budgets, PredictionBounds bounds);

}  // namespace arris::test
