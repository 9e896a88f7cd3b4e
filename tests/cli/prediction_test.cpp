/// @file Predictions of memory and temporary files.

#include <gtest/gtest.h>

#include "prediction_runs.h"
#include "support/sanitizers.h"

namespace arris::test {
namespace {

// Most of the memory of small scans is the program's own. Looser than what is promised of large ones.
TEST(Prediction, SmallScan_IsNear) {
  ARRIS_SKIP_UNDER_SANITIZERS;
  expect_predictions(300'000, {"1GiB"}, {0.85, 1.4});
}

}  // namespace
}  // namespace arris::test
