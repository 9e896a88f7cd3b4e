#include "pipeline/frontier_estimate.h"

#include <algorithm>
#include <vector>

#include "core/parallel.h"
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

/// What a cell tells.
struct CellFrontier {
  std::uint64_t points = 0;
  std::uint64_t proven = 0;  ///< Points whose support lies in the cell.
  std::uint64_t bytes = 0;   ///< Of the frontier of these.
};

CellFrontier frontier_of(const CellSample::View& cell, std::span<const std::uint8_t> intensities,
                         const Lattice& lattice, const SegmentParameters& parameters) {
  TilePoints points;
  const auto& [positions, ids] = *cell.points;
  tiling::fold_duplicates({positions.begin(), positions.end()}, {ids.begin(), ids.end()}, points);
  points.core = points.covered = cell.box;
  std::vector<std::uint8_t> of_entry(intensities.empty() ? 0 : points.ids.size());
  for (std::size_t i = 0; i < of_entry.size(); ++i) of_entry[i] = intensities[points.ids[i]];
  std::vector<std::byte> bytes;
  const std::uint64_t proven =
      grow_proven(points, of_entry, lattice, parameters, [&](std::span<const std::uint32_t> records) {
        merge::encode_frontier(records, 4 + parameters.most_neighbours(), bytes);
      });
  return {points.ids.size(), proven, bytes.size()};
}

}  // namespace

double most_frontier_bytes_per_point(const SegmentParameters& parameters) {
  return kHeadBytes + kNeighbourBytes * static_cast<double>(parameters.most_neighbours());
}

double frontier_sample(std::uint64_t points) {
  return std::clamp(0.015 * static_cast<double>(points), 20'000.0, 300'000.0);
}

double frontier_bytes_per_point(const CellSample& sample, std::span<const std::uint8_t> intensities,
                                const Lattice& lattice, const SegmentParameters& parameters) {
  const std::vector<CellSample::View> cells = sample.cells();
  std::vector<CellFrontier> found(cells.size());
  parallel_for_chunks(cells.size(), 1, [&](std::size_t i, std::size_t) {
    found[i] = frontier_of(cells[i], intensities, lattice, parameters);
  });
  std::uint64_t queries = 0, points_of_cells = 0;
  double bytes_of_cells = 0.0;
  for (const CellFrontier& cell : found) {
    if (cell.proven < kLeastCellQueries) continue;
    queries += cell.proven;
    points_of_cells += cell.points;
    // Where points are dense, more of them are proven: each cell counts by its points.
    bytes_of_cells +=
        static_cast<double>(cell.bytes) * static_cast<double>(cell.points) / static_cast<double>(cell.proven);
  }
  if (queries < kLeastQueries) return kUsualShare * most_frontier_bytes_per_point(parameters);
  return kMargin * bytes_of_cells / static_cast<double>(points_of_cells);
}

}  // namespace arris::pipeline
