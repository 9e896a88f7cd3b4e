#include "features/zheng/zheng_method.h"

#include <algorithm>

#include "core/parallel.h"
#include "features/neighbourhood/query_loop.h"
#include "features/zheng/healed_runner.h"
#include "features/zheng/zheng_runner.h"

namespace arris {

/// The tree and the labels in its order (31), building it (16), and found points and records (104 each) of scans that
/// are contours in one point of seven at most.
const double kZhengBytesPerPoint = 64.0;
const double kZhengBytesPerThread = 4.0 * 1024 * 1024;

namespace {

/// Gives what was found at a position to its duplicates too.
void add_duplicates(const PointTree& tree, const TilePoints& tile, std::span<const ZhengFound> found,
                    std::vector<ContourRecord>& records) {
  std::vector<std::pair<std::uint32_t, const ContourRecord*>> at;
  for (const ZhengFound& f : found) at.emplace_back(tree.entry(f.slot), &f.record);
  std::sort(at.begin(), at.end());
  for (const auto& [id, entry] : tile.duplicates) {
    const auto it = std::lower_bound(at.begin(), at.end(), entry,
                                     [](const auto& a, std::uint32_t wanted) { return a.first < wanted; });
    if (it == at.end() || it->first != entry) continue;
    records.push_back(*it->second);
    records.back().id = id;
  }
}

std::vector<std::uint32_t> in_tree_order(const PointTree& tree, std::span<const std::uint32_t> labels) {
  std::vector<std::uint32_t> ordered(tree.size());
  parallel_for_chunks(ordered.size(), std::size_t{1} << 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t slot = begin; slot < end; ++slot) ordered[slot] = labels[tree.entry(slot)];
  });
  return ordered;
}

}  // namespace

TileContours extract_zheng(const TilePoints& tile, std::span<const std::uint32_t> labels, const SupervoxelTable& table,
                           const Lattice& lattice, const ZhengParameters& parameters) {
  const ZhengSettings settings(parameters, lattice);
  TileContours contours;
  if (tile.positions.empty()) return contours;
  const PointTree tree(tile.positions, tile.ids);
  const std::vector<std::uint32_t> ordered = in_tree_order(tree, labels);
  const ZhengTask task{tree, ordered, table, settings};
  std::vector<ZhengFound> found;
  const auto collect = [&](const auto& runner) {
    found.insert(found.end(), runner.found().begin(), runner.found().end());
  };
  if (parameters.improved) {
    run_queries(
        tree, tile, nullptr, [&] { return HealedRunner(task); }, collect);
  } else {
    run_queries(
        tree, tile, nullptr, [&] { return ZhengRunner(task); }, collect);
  }
  contours.records.reserve(found.size());
  for (const ZhengFound& f : found) contours.records.push_back(f.record);
  if (!tile.duplicates.empty()) add_duplicates(tree, tile, found, contours.records);
  std::sort(contours.records.begin(), contours.records.end(),
            [](const ContourRecord& a, const ContourRecord& b) { return a.id < b.id; });
  return contours;
}

}  // namespace arris
