#include "features/segment_contours/segment_contours.h"

#include <algorithm>

#include "features/neighbourhood/query_loop.h"
#include "features/neighbourhood/tree_labels.h"
#include "features/segment_contours/segment_contour_runner.h"

namespace arris {

/// The tree and the labels in its order (31), building it (16), and records, found points (104 each) and edges (48 and
/// as much again while the vector grows) of scans that are contours in one point of five at most.
const double kSegmentContourBytesPerPoint = 96.0;
const double kSegmentContourBytesPerThread = 4.0 * 1024 * 1024;

SegmentContours analyse_segment_contours(const TilePoints& tile, std::span<const std::uint32_t> labels,
                                         std::span<const SegmentPlane> planes, const Lattice& lattice,
                                         const SegmentContourParameters& parameters) {
  segment_contour_halo(parameters, planes, lattice);  // Checks.
  SegmentContours contours;
  if (tile.positions.empty()) return contours;
  const PointTree tree(tile.positions, tile.ids);
  const PageVector<std::uint32_t> ordered = in_tree_order(tree, labels);
  const SegmentTask task{tree, ordered, planes, lattice, parameters};
  FoundRecords found;
  const auto collect = [&](const SegmentContourRunner& runner) {
    found.insert(found.end(), runner.found().begin(), runner.found().end());
    contours.edges.insert(contours.edges.end(), runner.edges().begin(), runner.edges().end());
  };
  run_queries(
      tree, tile, nullptr, [&] { return SegmentContourRunner(task); }, collect);
  contours.records = records_of(tree, tile, found);
  std::sort(contours.edges.begin(), contours.edges.end());
  return contours;
}

}  // namespace arris
