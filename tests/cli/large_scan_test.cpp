/// @file A scan far larger than the budget. Minutes.

#include <gtest/gtest.h>

#include "support/arris_process.h"
#include "support/temp_folder.h"

namespace arris::test {
namespace {

TEST(LargeScan, TwentyMillionPointsIn512MiB_KeepsTheBudget) {
  const TempFolder folder;
  const std::string scan = folder / "scan.las";
  ASSERT_EQ(run_arris({"synth", "town", "--points", "20000000", "--noise", "2mm", "-o", scan, "--truth",
                       folder / "truth.csv"})
                .exit_code,
            0);
  const ProcessResult run =
      run_arris({"extract", scan, "-o", folder / "edges.las", "--memory", "512MiB", "--temp-dir", folder.path()});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_LE(run.peak_resident_bytes, 512ULL << 20);
  RecordProperty("peak_resident_mib", static_cast<int>(run.peak_resident_bytes >> 20));
}

}  // namespace
}  // namespace arris::test
