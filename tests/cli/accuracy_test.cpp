/// @file The accuracy that the documentation promises of `extract` with defaults, on scenes with exact truth. Bars lie
/// a little below what was measured (one seed).

#include <gtest/gtest.h>

#include "accuracy_runs.h"
#include "support/sanitizers.h"

namespace arris::test {
namespace {

class BlockFolds : public ::testing::TestWithParam<Promise> {};

TEST_P(BlockFolds, Defaults_KeepThePromise) {
  ARRIS_SKIP_UNDER_SANITIZERS;
  EXPECT_GE(block_folds_f1(GetParam()), GetParam().least_f1);
}

INSTANTIATE_TEST_SUITE_P(Liu, BlockFolds,
                         ::testing::Values(Promise{"liu", "jittered", "0.25", "0", 0.95},
                                           Promise{"liu", "jittered", "0.25", "0.05", 0.88}));
INSTANTIATE_TEST_SUITE_P(Arris, BlockFolds,
                         ::testing::Values(Promise{"arris", "jittered", "0.25", "0", 0.99},
                                           Promise{"arris", "jittered", "0.25", "0.05", 0.985},
                                           Promise{"arris", "jittered", "0.25", "0.1", 0.955},
                                           Promise{"arris", "jittered", "0.25", "0.2", 0.83},
                                           Promise{"arris", "random", "0.25", "0", 0.955},
                                           Promise{"arris", "random", "0.25", "0.05", 0.95},
                                           Promise{"arris", "random", "0.25", "0.1", 0.92}));

class PlatesBoundary : public ::testing::TestWithParam<Promise> {};

TEST_P(PlatesBoundary, Defaults_KeepThePromise) {
  ARRIS_SKIP_UNDER_SANITIZERS;
  EXPECT_GE(plates_boundary_f1(GetParam()), GetParam().least_f1);
}

INSTANTIATE_TEST_SUITE_P(Liu, PlatesBoundary,
                         ::testing::Values(Promise{"liu", "grid", "0.25", "0", 0.97},
                                           Promise{"liu", "grid", "0.25", "0.05", 0.90}));
INSTANTIATE_TEST_SUITE_P(Arris, PlatesBoundary,
                         ::testing::Values(Promise{"arris", "jittered", "0.1", "0", 0.985},
                                           Promise{"arris", "jittered", "0.1", "0.02", 0.96},
                                           Promise{"arris", "random", "0.1", "0", 0.81},
                                           Promise{"arris", "random", "0.1", "0.02", 0.79},
                                           Promise{"arris", "grid", "0.25", "0", 0.98},
                                           Promise{"arris", "grid", "0.25", "0.05", 0.945}));

TEST(Accuracy, LayersTwoSpacingsApart_KeepTheirBorders) {
  const Accuracy found = accuracy("arris", {"plates", "--spacing", "0.1", "--set", "gap_spacings=2"},
                                  {"--edges", "boundaries", "--classes", "boundary"});
  EXPECT_GE(found.precision, 0.97);
  EXPECT_GE(found.f1, 0.85);
}

TEST(Accuracy, ScannedTown_WhatIsFoundIsRight) {
  ARRIS_SKIP_UNDER_SANITIZERS;
  const Accuracy found = accuracy("arris", {"town", "--points", "300000", "--noise", "2mm"}, {"--local-spacing"});
  EXPECT_GE(found.precision, 0.92);
  EXPECT_GE(found.f1, 0.62);
}

}  // namespace
}  // namespace arris::test
