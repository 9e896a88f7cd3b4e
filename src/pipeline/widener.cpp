#include "pipeline/widener.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <unordered_map>
#include <utility>

#include "core/error.h"
#include "core/pages.h"
#include "core/parallel.h"
#include "core/process_memory.h"
#include "core/text.h"
#include "tiling/morton.h"
#include "tiling/query_regions.h"

namespace arris::pipeline {
namespace {

/// To look ahead for fewer costs more readings than it saves.
constexpr std::size_t kLeastAheadQueries = 256;
/// With less the same tile files are read again and again.
constexpr std::uint64_t kLeastGroupBytes = std::uint64_t{64} << 20;

tiling::QueryRegions regions_of(std::span<const UnprovenQuery> queries) {
  tiling::QueryRegions regions;
  for (const UnprovenQuery& query : queries) regions.add(query.position, query.reach_steps);
  return regions;
}

/// Queries near each other should come together: what is in reach of them is then much the same.
void sort_by_place(std::vector<UnprovenQuery>& queries) {
  std::ranges::sort(queries, [](const UnprovenQuery& a, const UnprovenQuery& b) {
    return a.position == b.position ? a.id < b.id : tiling::z_order_less(a.position, b.position);
  });
}

/// Every round must look farther, or it would never end.
void require_progress(std::span<const UnprovenQuery> before, std::span<const UnprovenQuery> after) {
  std::unordered_map<std::uint64_t, std::int64_t> reach_of;
  for (const UnprovenQuery& query : before) reach_of.emplace(query.id, query.reach_steps);
  for (const UnprovenQuery& query : after) {
    if (query.reach_steps <= reach_of.at(query.id))
      throw IoError("internal: a query stayed unproven on complete support; please report this");
  }
}

}  // namespace

Widener::Widener(const TileJob& job, const TileAnalysis& analysis, const tiling::TileStore& store)
    : job_(job),
      analysis_(analysis),
      store_(store),
      all_bytes_(job.memory.widen_bytes()),
      group_bytes_(std::min(all_bytes_,
                            std::max(kLeastGroupBytes, static_cast<std::uint64_t>(job.memory.tile_workers) *
                                                           job.memory.tile_bytes(job.tiles.largest_covered_points)))) {}

std::vector<UnprovenQuery> Widener::answer(std::span<const UnprovenQuery> queries) {
  farther_.clear();
  look_around(queries);
  for (const UnprovenQuery& query : std::exchange(alone_, {})) answer_alone(query);
  return std::move(farther_);
}

/// A fifth of the memory holds what is around the queries, half what is analysed of it, the rest what is on its way
/// from one to the other.
void Widener::look_around(std::span<const UnprovenQuery> queries) {
  const std::uint64_t most_points = group_bytes_ / 5 / NearbyPoints::kBytesPerPoint;
  const auto look_around_halves = [&] {
    look_around(queries.first(queries.size() / 2));
    look_around(queries.subspan(queries.size() / 2));
  };
  if (ahead_queries_ >= kLeastAheadQueries) {
    if (queries.size() > ahead_queries_) return look_around_halves();
    const std::vector<UnprovenQuery> far = as_far_as_ever(queries);
    if (const std::optional<NearbyPoints> points = read(far, most_points, Detail::kLeaves))
      return answer_within(*points, queries, far);
    ahead_queries_ = queries.size() / 2;  // What does not fit here is unlikely to fit elsewhere.
    if (ahead_queries_ >= kLeastAheadQueries) return look_around_halves();
  }
  if (const std::optional<NearbyPoints> points = read(queries, most_points, Detail::kPoints)) {
    answer_within(*points, queries, queries);
  } else if (queries.size() == 1) {
    alone_.push_back(queries[0]);
  } else {
    look_around_halves();
  }
}

/// The same queries with the greatest reach that they will ever tell, where that is known.
std::vector<UnprovenQuery> Widener::as_far_as_ever(std::span<const UnprovenQuery> queries) const {
  std::vector<UnprovenQuery> far(queries.begin(), queries.end());
  for (UnprovenQuery& query : far)
    query.reach_steps = std::max(query.reach_steps, std::min(query.most_reach_steps, job_.farthest_steps));
  return far;
}

/// Who must look farther does so in the same points, as long as they reach.
/// @param read  the same queries, with the reaches that the points were read for.
void Widener::answer_within(const NearbyPoints& points, std::span<const UnprovenQuery> queries,
                            std::span<const UnprovenQuery> read) {
  std::unordered_map<std::uint64_t, std::int64_t> reach_of;
  for (const UnprovenQuery& query : read) reach_of.emplace(query.id, query.reach_steps);
  std::vector<UnprovenQuery> open(queries.begin(), queries.end());
  std::vector<UnprovenQuery> beyond = std::exchange(farther_, {});
  while (!open.empty()) {
    sort_by_place(open);
    answer_among(points, open);
    open.clear();
    for (const UnprovenQuery& query : std::exchange(farther_, {}))
      (query.reach_steps <= reach_of.at(query.id) ? open : beyond).push_back(query);
  }
  farther_ = std::move(beyond);
}

void Widener::answer_among(const NearbyPoints& all, std::span<const UnprovenQuery> queries) {
  std::optional<TilePoints> points = all.in(regions_of(queries), job_.memory.points_within(group_bytes_ / 2));
  if (points) {
    analyse(std::move(*points), queries);
  } else if (queries.size() == 1) {
    alone_.push_back(queries[0]);
  } else {
    answer_among(all, queries.first(queries.size() / 2));
    answer_among(all, queries.subspan(queries.size() / 2));
  }
}

/// All of the memory for one.
void Widener::answer_alone(const UnprovenQuery& query) {
  const std::span<const UnprovenQuery> queries(&query, 1);
  std::optional<NearbyPoints> all = read(queries, job_.memory.points_within(all_bytes_), Detail::kPoints);
  if (!all) {
    const std::uint64_t among = count_around(query);
    MemoryRequest request = job_.memory_request;
    request.kept_bytes = 0;  // It is resident by now.
    throw BudgetError(
        fmt::format("the neighbours of point {} lie among {} points that must be seen together; run with at least "
                    "--memory {}",
                    query.id, grouped(among), budget_text(least_budget_bytes(among, request))));
  }
  std::optional<TilePoints> points = all->in(regions_of(queries), all->size());
  all.reset();
  analyse(std::move(*points), queries);
}

std::uint64_t Widener::count_around(const UnprovenQuery& query) const {
  const tiling::QueryRegions regions = regions_of(std::span(&query, 1));
  std::uint64_t count = 0;
  for (std::size_t tile = 0; tile < job_.tiles.tiles.size(); ++tile) {
    if (!regions.touches(job_.tiles.tiles[tile].core)) continue;
    const auto counted = [&](const LatticePoint& p) {
      count += regions.contains(p);
      return false;
    };
    store_.load_core(tile, counted, [&](const LatticeBox& box) { return regions.touches(box); });
  }
  return count;
}

void Widener::analyse(TilePoints&& points, std::span<const UnprovenQuery> queries) {
  std::unordered_map<std::uint64_t, std::uint32_t> index_of;
  for (const UnprovenQuery& query : queries) index_of.emplace(query.id, std::numeric_limits<std::uint32_t>::max());
  for (std::uint32_t i = 0; i < points.ids.size(); ++i) {
    const auto found = index_of.find(points.ids[i]);
    if (found != index_of.end()) found->second = i;
  }
  std::vector<PlacedQuery> placed;
  for (const UnprovenQuery& query : queries) placed.push_back({index_of.at(query.id), query.reach_steps});
  const TileOutcome answered = analysis_(points, placed, [] {});
  points = {};
  isolated_ += answered.isolated;
  require_progress(queries, answered.unproven);
  farther_.insert(farther_.end(), answered.unproven.begin(), answered.unproven.end());
}

/// One analysis has the pages of another, up to the half of the memory that is theirs.
void Widener::leave_for_reading(std::uint64_t bytes) const {
  trim_heap();
  trim_spare_pages(std::min(group_bytes_ / 2, group_bytes_ - std::min(group_bytes_, bytes)));
}

std::optional<NearbyPoints> Widener::read(std::span<const UnprovenQuery> queries, std::uint64_t most_points,
                                          Detail detail) {
  const tiling::QueryRegions regions = regions_of(queries);
  std::vector<std::size_t> touched;
  for (std::size_t tile = 0; tile < job_.tiles.tiles.size(); ++tile) {
    if (regions.touches(job_.tiles.tiles[tile].core)) touched.push_back(tile);
  }
  const std::uint64_t load_bytes = tiling::load_bytes(job_.tiles.largest_covered_points);
  const std::uint64_t at_once = group_bytes_ / 5 * 4 / load_bytes;
  const auto lanes = static_cast<std::size_t>(std::clamp<std::uint64_t>(at_once, 1, loop_threads()));
  leave_for_reading(most_points * NearbyPoints::kBytesPerPoint + lanes * load_bytes);
  std::vector<tiling::SortedPoints> loaded(touched.size());
  std::atomic<std::size_t> next{0};
  std::atomic<std::uint64_t> points{0};
  parallel_for_chunks(lanes, 1, [&](std::size_t, std::size_t) {
    for (std::size_t i = next++; i < touched.size() && points <= most_points; i = next++) {
      loaded[i] = store_.load_core(
          touched[i], [&](const LatticePoint& p) { return detail == Detail::kLeaves || regions.contains(p); },
          [&](const LatticeBox& box) { return regions.touches(box); });
      points += loaded[i].positions.size();
    }
  });
  if (points > most_points) return std::nullopt;
  return NearbyPoints(std::move(loaded));
}

}  // namespace arris::pipeline
