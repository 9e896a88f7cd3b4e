#include "features/zheng/zheng_method.h"

#include "features/contour/found_records.h"
#include "features/neighbourhood/query_loop.h"
#include "features/neighbourhood/tree_labels.h"
#include "features/zheng/healed_runner.h"
#include "features/zheng/zheng_runner.h"

namespace arris {

/// The tree and the labels in its order (31), building it (16), and found points and records (104 each) of scans that
/// are contours in one point of seven at most.
const double kZhengBytesPerPoint = 60.0;
const double kZhengBytesPerThread = 4.0 * 1024 * 1024;

TileContours extract_zheng(const TilePoints& tile, std::span<const std::uint32_t> labels, const SupervoxelTable& table,
                           const Lattice& lattice, const ZhengParameters& parameters) {
  const ZhengSettings settings(parameters, lattice);
  TileContours contours;
  if (tile.positions.empty()) return contours;
  const PointTree tree(tile.positions, tile.ids);
  const PageVector<std::uint32_t> ordered = in_tree_order(tree, labels);
  const ZhengTask task{tree, ordered, table, settings};
  FoundRecords found;
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
  contours.records = records_of(tree, tile, found);
  return contours;
}

}  // namespace arris
