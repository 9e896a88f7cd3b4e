#include "pipeline/memory_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/pages.h"
#include "core/process_memory.h"
#include "core/text.h"
#include "tiling/point_grid.h"
#include "tiling/tile_store.h"

namespace arris::pipeline {
namespace {

constexpr std::uint64_t kMiB = 1024 * 1024;
constexpr std::uint64_t kLeastSpoolBytes = 4 * kMiB;
/// The survey's counts (bounded by their number of leaves), the read buffers and batches of one input, one writer, and
/// thread stacks; measured, rounded up.
constexpr std::uint64_t kPassBytes = 36 * kMiB;
/// Queries, the index of the regions of few, blocks of tile files.
constexpr std::uint64_t kWidenBytes = 8 * kMiB;
/// Beyond this a larger tile saves nothing: its halo is already a few percent of its core.
constexpr std::uint64_t kLargestTilePoints = 2'000'000;
/// On top of the least budget that is named: what is resident differs from run to run.
constexpr std::uint64_t kSpareBytes = 4 * kMiB;
/// Kept free: the allocator's fragments and what predictions miss.
constexpr double kSafety = 0.92;

std::uint64_t scratch_bytes(const MemoryRequest& request) {
  return static_cast<std::uint64_t>(request.threads) * static_cast<std::uint64_t>(request.method.per_thread);
}

std::uint64_t fixed_bytes(const MemoryRequest& request, std::uint64_t resident, std::uint64_t spool_buffer_bytes) {
  return request.kept_bytes + resident + kPassBytes + spool_buffer_bytes + scratch_bytes(request);
}

std::uint64_t spool_buffer_bytes(std::uint64_t budget_bytes) {
  return std::clamp<std::uint64_t>(budget_bytes / 32, kLeastSpoolBytes, 64 * kMiB);
}

std::uint64_t bytes_of_tile(std::uint64_t points, const MethodBytes& method) {
  const auto analyse =
      tiling::load_bytes(points) + static_cast<std::uint64_t>(method.per_point * static_cast<double>(points));
  return std::max(tiling::build_bytes(points), analyse);
}

}  // namespace

std::uint64_t resident_with_grids() {
  return resident_bytes() + tiling::point_grid_bytes_to_come();
}

std::uint64_t MemoryPlan::tile_bytes(std::uint64_t points) const {
  return bytes_of_tile(points, method);
}

std::uint64_t MemoryPlan::points_within(std::uint64_t bytes, std::uint64_t most) const {
  std::uint64_t low = 0, high = most + 1;  // The number lies in [low, high).
  while (high - low > 1) {
    const std::uint64_t middle = low + (high - low) / 2;
    (tile_bytes(middle) <= bytes ? low : high) = middle;
  }
  return low;
}

std::uint64_t MemoryPlan::widen_bytes() const {
  const auto usable = static_cast<std::uint64_t>(kSafety * static_cast<double>(budget_bytes));
  const std::uint64_t taken = resident_with_grids() - spare_pages_bytes() + scratch_bytes + kWidenBytes;
  return std::max(tiles_bytes, usable - std::min(usable, taken));
}

std::uint64_t least_budget_bytes(std::uint64_t points, const MemoryRequest& request) {
  const std::uint64_t resident = resident_with_grids();
  std::uint64_t spool = kLeastSpoolBytes;
  for (;;) {
    const std::uint64_t needed = fixed_bytes(request, resident, spool) + bytes_of_tile(points, request.method);
    const auto budget = static_cast<std::uint64_t>(static_cast<double>(needed) / kSafety) + kSpareBytes;
    // A larger budget has larger buffers, unless it could not do otherwise (plan_memory), until they no longer grow.
    if (points <= kLeastTilePoints || spool_buffer_bytes(budget) <= spool) return budget;
    spool = spool_buffer_bytes(budget);
  }
}

MemoryPlan plan_memory(const MemoryRequest& request) {
  MemoryPlan plan;
  plan.budget_bytes = request.budget_bytes;
  plan.method = request.method;
  plan.scratch_bytes = scratch_bytes(request);
  plan.spool_buffer_bytes = spool_buffer_bytes(request.budget_bytes);
  plan.resident_bytes = resident_with_grids();
  plan.fixed_bytes = fixed_bytes(request, plan.resident_bytes, plan.spool_buffer_bytes);
  const auto usable = static_cast<std::uint64_t>(kSafety * static_cast<double>(request.budget_bytes));
  if (usable < plan.fixed_bytes + plan.tile_bytes(kLeastTilePoints)) {  // Short of memory: the least buffer.
    plan.spool_buffer_bytes = kLeastSpoolBytes;
    plan.fixed_bytes = fixed_bytes(request, plan.resident_bytes, plan.spool_buffer_bytes);
  }
  if (usable < plan.fixed_bytes + plan.tile_bytes(kLeastTilePoints)) {
    throw BudgetError(fmt::format("--memory {} is too small: this run needs at least {}",
                                  human_bytes(request.budget_bytes),
                                  budget_text(least_budget_bytes(kLeastTilePoints, request))));
  }
  plan.tiles_bytes = usable - plan.fixed_bytes;
  plan.tile_workers = request.threads;
  while (plan.tile_workers > 1 && plan.tile_bytes(kFairTilePoints) * plan.tile_workers > plan.tiles_bytes)
    --plan.tile_workers;

  const std::uint64_t share = plan.tiles_bytes / plan.tile_workers;
  // Fewer workers have no larger tiles than more will have with a little more memory: a larger budget never gives
  // smaller tiles.
  const std::uint64_t most = plan.tile_workers < request.threads ? kFairTilePoints : kLargestTilePoints;
  plan.max_tile_points = plan.points_within(share, most);
  return plan;
}

}  // namespace arris::pipeline
