#include "pipeline/memory_plan.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/error.h"
#include "support/sanitizers.h"

namespace arris::pipeline {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;

RC_GTEST_PROP(MemoryPlan, AnyBudget_TilesInFlightFitOrTheRunIsRefused, ()) {
  const MemoryRequest request{*rc::gen::inRange<std::uint64_t>(1, 20'000) * kMiB, *rc::gen::inRange(1, 65)};
  try {
    const MemoryPlan plan = plan_memory(request);
    RC_ASSERT(plan.fixed_bytes + plan.tile_workers * plan.tile_bytes(plan.max_tile_points) <= request.budget_bytes);
    RC_ASSERT(plan.tile_workers >= 1);
    RC_ASSERT(plan.tile_workers <= request.threads);
    RC_ASSERT(plan.max_tile_points >= 1);
  } catch (const BudgetError&) {
    // The resident size that both start from may differ a little between the two calls.
    RC_ASSERT(request.budget_bytes < least_budget_bytes(kLeastTilePoints, request) + 8 * kMiB);
  }
}

TEST(MemoryPlan, LeastBudget_IsEnough) {
  // The resident size that the plan starts from may grow between the two calls.
  const std::uint64_t least = least_budget_bytes(kLeastTilePoints, {0, 2}) + 8 * kMiB;
  EXPECT_NO_THROW(plan_memory({least, 2}));
}

TEST(MemoryPlan, LargerBudget_NeverGivesSmallerTiles) {
  std::uint64_t last = 0;
  // A sanitizer's own memory counts as resident, after other tests more than the least of these.
  for (std::uint64_t budget = test::kAddressSanitizer ? 4096 : 256; budget <= 65536; budget *= 2) {
    const MemoryPlan plan = plan_memory({budget * kMiB, 2});
    EXPECT_GE(plan.max_tile_points, last);
    last = plan.max_tile_points;
  }
}

}  // namespace
}  // namespace arris::pipeline
