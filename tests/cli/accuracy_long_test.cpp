/// @file Promises of accuracy that take longer to keep: much noise, large scans.

#include <gtest/gtest.h>

#include "accuracy_runs.h"

namespace arris::test {
namespace {

TEST(AccuracyLong, BlockFolds_RandomSamplingAndNoiseOfMostOfTheSpacing) {
  EXPECT_GE(block_folds_f1({"arris", "random", "0.25", "0.2", 0.0}), 0.80);
}

TEST(AccuracyLong, ScannedTown_WhatIsFoundIsRight) {
  const Accuracy found = accuracy("arris", {"town", "--points", "3000000", "--noise", "2mm"}, {"--local-spacing"});
  EXPECT_GE(found.precision, 0.89);
  EXPECT_GE(found.f1, 0.77);
}

}  // namespace
}  // namespace arris::test
