#include "pipeline/widen_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "pipeline/tile_stage.h"
#include "pipeline/widener.h"

namespace arris::pipeline {
namespace {

/// Queries whose surroundings are read together: each tile file is then read once for all of them. Their regions take
/// 125 cells of 16 bytes each at most, usually shared, and links of 8, which is little beside what they look at.
constexpr std::uint64_t kMostGroupQueries = 8192, kLeastGroupQueries = 512, kBytesPerQuery = 16 * 1024;

}  // namespace

WidenResult run_widen_stage(const TileJob& job, const std::vector<std::uint64_t>& unproven,
                            const TileAnalysis& analysis, const std::filesystem::path& folder,
                            const tiling::TileStore& store, ProgressSink& progress, const CancelToken& cancel) {
  WidenResult outcome;
  outcome.queries = std::accumulate(unproven.begin(), unproven.end(), std::uint64_t{0});
  if (outcome.queries == 0) return outcome;
  progress.phase("widen", outcome.queries);
  Widener widener(job, analysis, store);
  const std::uint64_t most = std::clamp(widener.group_bytes() / kBytesPerQuery, kLeastGroupQueries, kMostGroupQueries);
  std::vector<UnprovenQuery> group, farther;
  const auto answer_group = [&] {
    cancel.check();
    const std::vector<UnprovenQuery> open = widener.answer(group);
    progress.advance(group.size() - open.size());
    farther.insert(farther.end(), open.begin(), open.end());
    group.clear();
  };
  const auto take = [&](const UnprovenQuery& query) {
    group.push_back(query);
    if (group.size() == most) answer_group();
  };
  for (std::size_t tile = 0; tile < unproven.size(); ++tile) {
    if (unproven[tile] == 0) continue;
    for (const UnprovenQuery& query : read_queries(folder / fmt::format("{}.queries", tile))) take(query);
  }
  // Who must look farther comes again with the others.
  while (!group.empty() || !farther.empty()) {
    for (const UnprovenQuery& query : std::exchange(farther, {})) take(query);
    if (!group.empty()) answer_group();
  }
  outcome.isolated = widener.isolated();
  return outcome;
}

}  // namespace arris::pipeline
