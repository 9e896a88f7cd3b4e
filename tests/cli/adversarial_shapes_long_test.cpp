/// @file Adversarial shapes far larger than the budget. An hour.

#include <gtest/gtest.h>

#include "adversarial_runs.h"
#include "adversarial_shapes.h"
#include "support/temp_folder.h"

namespace arris::test {
namespace {

struct LargeShape {
  std::string name;
  std::uint32_t points;
  std::uint64_t budget_mib;
};

class EveryLargeShape : public testing::TestWithParam<LargeShape> {};

TEST_P(EveryLargeShape, WithEveryCommand_KeepsTheBudget) {
  const LargeShape& large = GetParam();
  const TempFolder folder;
  const auto inputs = adversarial_shape(large.name).write(folder.path(), large.points);
  for (const AdversarialCommand& command : adversarial_commands()) {
    SCOPED_TRACE(command.name);
    run_within_budget(inputs, command, {.budget_mib = large.budget_mib}, large.points, folder / "out.las");
  }
}

INSTANTIATE_TEST_SUITE_P(
    Adversarial, EveryLargeShape,
    testing::Values(LargeShape{"coincident", 20'000'000, 512}, LargeShape{"solid_cube", 5'000'000, 256},
                    LargeShape{"hot_tile", 20'000'000, 512}, LargeShape{"two_stations", 20'000'000, 512},
                    LargeShape{"far_point", 20'000'000, 512}, LargeShape{"lone_points", 1'000'000, 256},
                    LargeShape{"hundred_files", 5'000'000, 256}, LargeShape{"extra_bytes", 5'000'000, 256},
                    LargeShape{"line_order", 20'000'000, 512}, LargeShape{"scattered_order", 20'000'000, 512}),
    [](const auto& of) { return of.param.name; });

}  // namespace
}  // namespace arris::test
