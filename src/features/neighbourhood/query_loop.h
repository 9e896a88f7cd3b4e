#pragma once
/// @file Runs a method's runner over the queries of a tile, bucket by bucket, in parallel.

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "core/tile_points.h"
#include "features/contour/tile_contours.h"
#include "features/neighbourhood/point_tree.h"
#include "features/neighbourhood/runner_pool.h"

namespace arris {

/// Buckets per work item: enough to make taking one cheap, few enough to balance the load.
constexpr std::size_t kChunkBuckets = 64;

/// The queries are the points of `tile.core`, or, if given, the entries whose `wanted` is not 0.
/// @param make    returns a runner with run(span of slots that are close together) and take_unproven().
/// @param finish  called with each runner when all is done, one at a time. There is one for every thread that ran.
/// @return unproven queries, ascending ids.
template <class Make, class Finish>
std::vector<UnprovenQuery> run_queries(const PointTree& tree, const TilePoints& tile,
                                       const std::vector<std::uint8_t>* wanted, Make&& make, Finish&& finish) {
  using Runner = decltype(make());
  RunnerPool<Runner> pool;
  parallel_for_chunks(tree.buckets(), kChunkBuckets, [&](std::size_t first, std::size_t last) {
    pool.with_one(make, [&](Runner& runner) {
      std::vector<std::uint32_t> slots;
      for (std::size_t bucket = first; bucket < last; ++bucket) {
        slots.clear();
        const std::size_t end = tree.bucket_begin(bucket + 1);
        for (std::size_t slot = tree.bucket_begin(bucket); slot < end; ++slot) {
          const bool asked = wanted ? (*wanted)[tree.entry(slot)] != 0 : tile.core.contains(tree.position(slot));
          if (asked) slots.push_back(static_cast<std::uint32_t>(slot));
        }
        if (!slots.empty()) runner.run(slots);
      }
    });
  });
  std::vector<UnprovenQuery> unproven;
  for (std::unique_ptr<Runner>& runner : pool.idle()) {
    const std::vector<UnprovenQuery> more = runner->take_unproven();
    unproven.insert(unproven.end(), more.begin(), more.end());
    finish(*runner);
    runner.reset();
  }
  std::sort(unproven.begin(), unproven.end(),
            [](const UnprovenQuery& a, const UnprovenQuery& b) { return a.id < b.id; });
  return unproven;
}

}  // namespace arris
