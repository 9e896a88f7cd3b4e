#include "pipeline/widen_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <unordered_map>

#include "core/error.h"
#include "core/parallel.h"
#include "core/process_memory.h"
#include "core/text.h"
#include "pipeline/tile_stage.h"
#include "tiling/point_grid.h"
#include "tiling/query_regions.h"

namespace arris::pipeline {
namespace {

/// Queries answered together, of as many tiles as it takes: each tile file is then read once for all of them. Bounds
/// the memory of their regions (125 cells of 16 bytes each at most, usually shared: 16 MiB).
constexpr std::size_t kGroupQueries = 8192;

class Widener {
 public:
  Widener(const TileJob& job, const TileAnalysis& analysis, const tiling::TileStore& store, WidenResult& outcome)
      : job_(job), analysis_(analysis), store_(store), bytes_(job.memory.widen_bytes()), outcome_(outcome) {}

  void answer(std::span<const UnprovenQuery> queries) {
    std::optional<TilePoints> points = collect(queries);
    if (!points) {
      if (queries.size() == 1) {
        const std::uint64_t among = count(queries);
        throw BudgetError(
            fmt::format("the neighbours of point {} lie among {} points that must be seen together; run with at "
                        "least --memory {}",
                        queries[0].id, grouped(among), budget_text(least_budget_bytes(among, job_.memory_request))));
      }
      const std::size_t half = queries.size() / 2;
      answer(queries.first(half));
      answer(queries.subspan(half));
      return;
    }
    std::unordered_map<std::uint64_t, std::uint32_t> index_of;
    for (const UnprovenQuery& query : queries) index_of.emplace(query.id, std::numeric_limits<std::uint32_t>::max());
    for (std::uint32_t i = 0; i < points->ids.size(); ++i) {
      const auto found = index_of.find(points->ids[i]);
      if (found != index_of.end()) found->second = i;
    }
    std::vector<PlacedQuery> placed;
    for (const UnprovenQuery& query : queries) placed.push_back({index_of.at(query.id), query.reach_steps});
    const TileOutcome answered = analysis_(*points, placed);
    points.reset();
    outcome_.isolated += answered.isolated;
    if (answered.unproven.empty()) return;
    require_progress(queries, answered.unproven);
    answer(answered.unproven);
  }

 private:
  /// Every round must look farther, or it would never end.
  static void require_progress(std::span<const UnprovenQuery> before, std::span<const UnprovenQuery> after) {
    std::unordered_map<std::uint64_t, std::int64_t> reach_of;
    for (const UnprovenQuery& query : before) reach_of.emplace(query.id, query.reach_steps);
    for (const UnprovenQuery& query : after) {
      if (query.reach_steps <= reach_of.at(query.id))
        throw IoError("internal: a query stayed unproven on complete support; please report this");
    }
  }

  /// Calls taken() with the points in reach of the queries, tile by tile in order; false as soon as it says no.
  bool gather(std::span<const UnprovenQuery> queries,
              const std::function<bool(const tiling::SortedPoints& some)>& taken) {
    tiling::QueryRegions regions;
    for (const UnprovenQuery& query : queries) regions.add(query.position, query.reach_steps);
    std::vector<std::size_t> touched;
    for (std::size_t tile = 0; tile < job_.tiles.tiles.size(); ++tile) {
      if (regions.touches(job_.tiles.tiles[tile].core)) touched.push_back(tile);
    }
    // As many tiles at once as were analysed at once, which took more memory.
    std::vector<tiling::SortedPoints> loaded(static_cast<std::size_t>(job_.memory.tile_workers));
    for (std::size_t begin = 0; begin < touched.size(); begin += loaded.size()) {
      const std::size_t tiles = std::min(loaded.size(), touched.size() - begin);
      parallel_for_chunks(tiles, 1, [&](std::size_t i, std::size_t) {
        store_.load_core(
            touched[begin + i], [&](const LatticePoint& p) { return regions.contains(p); }, loaded[i].positions,
            loaded[i].ids, [&](const LatticeBox& box) { return regions.touches(box); });
      });
      for (std::size_t i = 0; i < tiles; ++i) {
        if (!taken(loaded[i])) return false;
        loaded[i] = {};
      }
    }
    return true;
  }

  std::uint64_t count(std::span<const UnprovenQuery> queries) {
    std::uint64_t points = 0;
    gather(queries, [&](const tiling::SortedPoints& some) {
      points += some.positions.size();
      return true;
    });
    return points;
  }

  /// The points in reach of the queries, or nothing if there are too many.
  std::optional<TilePoints> collect(std::span<const UnprovenQuery> queries) {
    std::vector<LatticePoint> positions;
    std::vector<std::uint64_t> ids;
    const bool fits = gather(queries, [&](const tiling::SortedPoints& some) {
      positions.insert(positions.end(), some.positions.begin(), some.positions.end());
      ids.insert(ids.end(), some.ids.begin(), some.ids.end());
      if (positions.size() > job_.memory.max_tile_points && queries.size() > 1) return false;
      return job_.memory.tile_bytes(positions.size()) <= bytes_;
    });
    if (!fits) return std::nullopt;
    TilePoints points;
    tiling::fold_duplicates(std::move(positions), std::move(ids), points);
    // Complete around every query as far as the query asked for, which is what its proof needs.
    constexpr std::int64_t kEverywhere = std::int64_t{1} << 40;
    points.core = {{-kEverywhere, -kEverywhere, -kEverywhere}, {kEverywhere, kEverywhere, kEverywhere}};
    points.covered = points.core;
    return points;
  }

  const TileJob& job_;
  const TileAnalysis& analysis_;
  const tiling::TileStore& store_;
  std::uint64_t bytes_;  ///< For the points of a group of queries.
  WidenResult& outcome_;
};

}  // namespace

WidenResult run_widen_stage(const TileJob& job, const std::vector<std::uint64_t>& unproven,
                            const TileAnalysis& analysis, const std::filesystem::path& folder,
                            const tiling::TileStore& store, ProgressSink& progress, const CancelToken& cancel) {
  WidenResult outcome;
  outcome.queries = std::accumulate(unproven.begin(), unproven.end(), std::uint64_t{0});
  if (outcome.queries == 0) return outcome;
  progress.phase("widen", outcome.queries);
  Widener widener(job, analysis, store, outcome);
  std::vector<UnprovenQuery> group;
  const auto answer_group = [&] {
    cancel.check();
    widener.answer(group);
    release_free_memory();
    progress.advance(group.size());
    group.clear();
  };
  for (std::size_t tile = 0; tile < unproven.size(); ++tile) {
    if (unproven[tile] == 0) continue;
    for (const UnprovenQuery& query : read_queries(folder / fmt::format("{}.queries", tile))) {
      group.push_back(query);
      if (group.size() == kGroupQueries) answer_group();
    }
  }
  if (!group.empty()) answer_group();
  return outcome;
}

}  // namespace arris::pipeline
