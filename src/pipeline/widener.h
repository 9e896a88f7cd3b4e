#pragma once
/// @file Answers queries that need a wider view than their tiles had.

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/nearby_points.h"
#include "pipeline/tile_job.h"
#include "tiling/tile_store.h"

namespace arris::pipeline {

/// Reads what is around queries from the tile files and runs the analysis on it. Tile files are read once for as many
/// queries as memory allows.
class Widener {
 public:
  Widener(const TileJob& job, const TileAnalysis& analysis, const tiling::TileStore& store);

  /// Returns those that must look farther still. Queries should come tile by tile. Throws BudgetError if what one of
  /// them asks for does not fit into the budget.
  std::vector<UnprovenQuery> answer(std::span<const UnprovenQuery> queries);
  /// So far.
  std::uint64_t isolated() const { return isolated_; }
  /// Memory for queries that are answered together.
  std::uint64_t group_bytes() const { return group_bytes_; }

 private:
  void look_around(std::span<const UnprovenQuery> queries);
  std::vector<UnprovenQuery> as_far_as_ever(std::span<const UnprovenQuery> queries) const;
  void answer_within(const NearbyPoints& points, std::span<const UnprovenQuery> queries,
                     std::span<const UnprovenQuery> read);
  void answer_among(const NearbyPoints& all, std::span<const UnprovenQuery> queries);
  void answer_alone(const UnprovenQuery& query);
  void analyse(TilePoints&& points, std::span<const UnprovenQuery> queries);
  std::uint64_t count_around(const UnprovenQuery& query) const;
  enum class Detail {
    kPoints,  ///< Those in reach, no others.
    kLeaves,  ///< And what lies with them in a leaf of a tile file: to look at each costs more than to keep it.
  };
  void leave_for_reading(std::uint64_t bytes) const;
  /// The points in reach of the queries, or nothing if there are more than that.
  std::optional<NearbyPoints> read(std::span<const UnprovenQuery> queries, std::uint64_t most_points, Detail detail);

  const TileJob& job_;
  const TileAnalysis& analysis_;
  const tiling::TileStore& store_;
  std::uint64_t all_bytes_;    ///< There are for points and their analysis.
  std::uint64_t group_bytes_;  ///< That groups take of them: hardly more than tiles did, which is what was foretold.
  std::uint64_t isolated_ = 0;
  /// What so many queries may come to ask for is read with what they ask for.
  std::size_t ahead_queries_ = std::numeric_limits<std::size_t>::max();
  std::vector<UnprovenQuery> farther_;  ///< Of the queries being answered.
  std::vector<UnprovenQuery> alone_;    ///< Have more around them than goes with others in memory.
};

}  // namespace arris::pipeline
