/// @file Clouds that no scanner delivers on purpose: every command does them within the budget.

#include "adversarial_shapes.h"

#include <gtest/gtest.h>

#include "adversarial_runs.h"
#include "support/las_tools.h"
#include "support/sanitizers.h"
#include "support/temp_folder.h"

namespace arris::test {
namespace {

constexpr std::uint32_t kPoints = 50'000;
/// The lone tenth of the hot tile asks again and again for a wider view of the rest: enough for a few tiles.
constexpr std::uint32_t kPointsOfHotTile = 12'000;

/// Name of the shape, index of the command.
class EveryShape : public testing::TestWithParam<std::tuple<AdversarialShape, AdversarialCommand>> {};

TEST_P(EveryShape, InTwoCuts_KeepsTheBudgetAndGivesTheSameBytes) {
  ARRIS_SKIP_UNDER_SANITIZERS;
  const auto& [shape, command] = GetParam();
  const TempFolder folder;
  const std::uint32_t points = shape.name == "hot_tile" ? kPointsOfHotTile : kPoints;
  const auto inputs = shape.write(folder.path(), points);
  const auto whole = folder / "whole.las", cut = folder / "cut.las";
  const bool done = run_within_budget(inputs, command, {.threads = 1}, points, whole);
  ASSERT_EQ(run_within_budget(inputs, command, {.threads = 2, .tile_points = "8000"}, points, cut), done);
  if (done) {
    EXPECT_TRUE(file_bytes(whole) == file_bytes(cut)) << "tiles change the output";
  }
}

INSTANTIATE_TEST_SUITE_P(Adversarial, EveryShape,
                         testing::Combine(testing::ValuesIn(adversarial_shapes()),
                                          testing::ValuesIn(adversarial_commands())),
                         [](const auto& of) { return std::get<0>(of.param).name + "_" + std::get<1>(of.param).name; });

/// Tiles of one point each.
TEST(Adversarial, TilesOfOnePoint_GiveTheSameBytes) {
  ARRIS_SKIP_UNDER_SANITIZERS;
  constexpr std::uint32_t kFewPoints = 400;
  const TempFolder folder;
  const auto inputs = adversarial_shape("lone_points").write(folder.path(), kFewPoints);
  for (const AdversarialCommand& command : adversarial_commands()) {
    SCOPED_TRACE(command.name);
    const auto whole = folder / "whole.las", cut = folder / "cut.las";
    const bool done = run_within_budget(inputs, command, {}, kFewPoints, whole);
    ASSERT_EQ(run_within_budget(inputs, command, {.tile_points = "1"}, kFewPoints, cut), done);
    if (done) {
      EXPECT_TRUE(file_bytes(whole) == file_bytes(cut)) << "tiles change the output";
    }
  }
}

}  // namespace
}  // namespace arris::test
