#include "features/liu_method.h"

#include <algorithm>
#include <mutex>

#include "core/parallel.h"
#include "features/liu_engine.h"
#include "features/liu_runner.h"

namespace arris {
namespace {

/// Buckets per work item: enough to make its scratch memory cheap, few enough to balance the load.
constexpr std::size_t kChunkBuckets = 64;

}  // namespace

TileContours extract_liu_with(const TilePoints& tile, const Lattice& lattice, const LiuParameters& parameters,
                              const std::vector<std::uint8_t>* wanted, const LiuSwitches& switches) {
  const LiuSettings settings(parameters, lattice, switches);
  TileContours contours;
  if (tile.positions.empty()) return contours;
  const PointTree tree(tile.positions, tile.ids);
  ContourAccumulator results(tree.size(), parameters.fold);
  const LiuTask task{tree, tile.covered, settings, results};
  std::mutex mutex;  // Guards contours.unproven.
  parallel_for_chunks(tree.buckets(), kChunkBuckets, [&](std::size_t first, std::size_t last) {
    LiuRunner runner(task);
    std::vector<std::uint32_t> slots;
    for (std::size_t bucket = first; bucket < last; ++bucket) {
      slots.clear();
      const std::size_t begin = tree.bucket_begin(bucket);
      const std::size_t end = tree.bucket_begin(bucket + 1);
      for (std::size_t slot = begin; slot < end; ++slot) {
        const bool asked = wanted ? (*wanted)[tree.entry(slot)] != 0 : tile.core.contains(tree.position(slot));
        if (asked) slots.push_back(static_cast<std::uint32_t>(slot));
      }
      runner.run(slots);
    }
    const std::vector<UnprovenQuery> unproven = runner.take_unproven();
    const std::lock_guard lock(mutex);
    contours.unproven.insert(contours.unproven.end(), unproven.begin(), unproven.end());
  });
  std::sort(contours.unproven.begin(), contours.unproven.end(),
            [](const UnprovenQuery& a, const UnprovenQuery& b) { return a.id < b.id; });
  ContourAccumulator::Outcome outcome = results.finish(tree, tile);
  contours.records = std::move(outcome.records);
  contours.isolated = outcome.isolated;
  return contours;
}

TileContours extract_liu(const TilePoints& tile, const Lattice& lattice, const LiuParameters& parameters) {
  return extract_liu_with(tile, lattice, parameters, nullptr, {});
}

TileContours extract_liu(const TilePoints& tile, const Lattice& lattice, const LiuParameters& parameters,
                         std::span<const std::uint32_t> queries) {
  std::vector<std::uint8_t> wanted(tile.positions.size());
  for (const std::uint32_t entry : queries) wanted[entry] = 1;
  return extract_liu_with(tile, lattice, parameters, &wanted, {});
}

}  // namespace arris
