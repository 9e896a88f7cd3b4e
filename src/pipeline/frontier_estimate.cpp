#include "pipeline/frontier_estimate.h"

#include <algorithm>

#include "features/segment/tile_growth.h"
#include "merge/frontier_coding.h"
#include "tiling/tile_store.h"

namespace arris::pipeline {
namespace {

/// Of records: as measured, rounded up.
constexpr double kHeadBytes = 11.0;
constexpr double kNeighbourBytes = 1.4;
/// With fewer points than these the sample says nothing.
constexpr std::uint64_t kLeastQueries = 500;
constexpr std::uint64_t kLeastCellQueries = 20;
constexpr double kUsualShare = 0.3;
/// Rather too much than too little: cells differ.
constexpr double kMargin = 1.05;

}  // namespace

double most_frontier_bytes_per_point(const SegmentParameters& parameters) {
  return kHeadBytes + kNeighbourBytes * static_cast<double>(parameters.most_neighbours());
}

double frontier_sample(std::uint64_t points) {
  return std::clamp(0.015 * static_cast<double>(points), 20'000.0, 300'000.0);
}

double frontier_bytes_per_point(const CellSample& sample, std::span<const std::uint8_t> intensities,
                                const Lattice& lattice, const SegmentParameters& parameters) {
  const std::size_t stride = 4 + parameters.most_neighbours();
  std::uint64_t queries = 0, points_of_cells = 0;
  double bytes_of_cells = 0.0;
  std::vector<std::byte> bytes;
  sample.for_each([&](const LatticeBox& box, const CellSample::Cell& cell) {
    TilePoints points;
    tiling::fold_duplicates(std::vector(cell.positions), std::vector(cell.ids), points);
    points.core = points.covered = box;
    std::vector<std::uint8_t> of_entry(intensities.empty() ? 0 : points.ids.size());
    for (std::size_t i = 0; i < of_entry.size(); ++i) of_entry[i] = intensities[points.ids[i]];
    bytes.clear();
    const TileGrowth grown =
        grow_tile(points, of_entry, lattice, parameters,
                  [&](std::span<const std::uint32_t> records) { merge::encode_frontier(records, stride, bytes); });
    // Where points are dense, more of them are proven: each cell counts by its points.
    const std::uint64_t proven = points.ids.size() - grown.unproven.size();
    if (proven < kLeastCellQueries) return;
    queries += proven;
    points_of_cells += points.ids.size();
    bytes_of_cells +=
        static_cast<double>(bytes.size()) * static_cast<double>(points.ids.size()) / static_cast<double>(proven);
  });
  if (queries < kLeastQueries) return kUsualShare * most_frontier_bytes_per_point(parameters);
  return kMargin * bytes_of_cells / static_cast<double>(points_of_cells);
}

}  // namespace arris::pipeline
