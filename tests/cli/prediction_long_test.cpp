/// @file The promise of predictions: within a quarter of what is measured, never under by more than a twentieth.

#include <gtest/gtest.h>

#include "prediction_runs.h"

namespace arris::test {
namespace {

TEST(PredictionLong, FiveMillionPoints_WithinAQuarter) {
  expect_predictions(5'000'000, {"256MiB", "1GiB"}, {0.95, 1.25});
}

}  // namespace
}  // namespace arris::test
