#include "pipeline/frontier_estimate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <utility>
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
/// Classes of large cells by their points: one for each power of four.
constexpr std::size_t kDensities = 32;
/// Cells of these classes are few and hold many points. The small cells in them, at 1/16 of the area, hold as many as
/// large ones do elsewhere.
constexpr std::size_t kLeastDense = 8;
/// Of large cells, 5 MB: more than scans of 100 million points have. Else nothing is made of densities.
constexpr std::size_t kMostCells = std::size_t{1} << 16;
using PointsByDensity = std::array<double, kDensities>;
/// Rather too much than too little: cells differ.
constexpr double kMargin = 1.09;

std::size_t density_of(std::uint64_t points) {
  return points == 0 ? 0 : static_cast<std::size_t>(std::bit_width(points) - 1) / 2;
}

/// How dense the scan is in the cells of a sample, drawn or not.
class CellDensities {
 public:
  CellDensities(const CellSample& sample, const tiling::Survey& survey) : sample_(sample) {
    if (survey.counts.level() > sample.level()) return;  // Counted in larger cells.
    bool fit = true;
    survey.counts.for_each_by_leaf([&](const LatticeBox& cell, std::uint64_t count) {
      if (fit) count_at(cell) += count;
      fit = count_of_.size() < kMostCells;
    });
    if (!fit) count_of_.clear();
  }
  bool are_known() const { return !count_of_.empty(); }
  /// Of the cell that holds the middle of a box.
  std::size_t at(const LatticeBox& box) { return density_of(count_at(box)); }
  PointsByDensity points() const {
    PointsByDensity points{};
    for (const auto& [place, count] : count_of_) points[density_of(count)] += static_cast<double>(count);
    return points;
  }

 private:
  std::uint64_t& count_at(const LatticeBox& box) {
    const auto middle = [&](int axis) { return static_cast<std::int32_t>((box.min[axis] + box.max[axis]) / 2); };
    return count_of_[sample_.place_of({middle(0), middle(1), middle(2)})];
  }

  const CellSample& sample_;
  std::map<LatticePoint, std::uint64_t> count_of_;
};

/// What a cell tells.
struct CellFrontier {
  std::size_t density = 0;
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
  return {0, points.ids.size(), proven, bytes.size()};
}

/// The frontier of the cells of one class.
class DensityFrontier {
 public:
  void add(const CellFrontier& cell) {
    if (cell.proven >= kLeastCellQueries) {
      add_known(cell);
    } else {
      sparse_.points += cell.points;
      sparse_.proven += cell.proven;
      sparse_.bytes += cell.bytes;
    }
  }
  /// Call it once all cells are there: those with few proven points tell together what none of them does alone.
  void finish() {
    if (sparse_.proven >= kLeastCellQueries) add_known(sparse_);
  }
  bool is_known() const { return points_ > 0.0; }
  double bytes_per_point() const { return bytes_ / points_; }

 private:
  void add_known(const CellFrontier& cell) {
    const auto points = static_cast<double>(cell.points);
    points_ += points;
    // Where points are dense, more of them are proven: each cell counts by its points.
    bytes_ += static_cast<double>(cell.bytes) * points / static_cast<double>(cell.proven);
  }

  CellFrontier sparse_;
  double points_ = 0.0, bytes_ = 0.0;
};

/// The mean over all points of the scan. Few cells are drawn, and how dense they are is chance; how much of the scan is
/// as dense as they are is known.
double mean_bytes_per_point(const std::vector<CellFrontier>& cells, const PointsByDensity& points) {
  std::array<DensityFrontier, kDensities> classes;
  DensityFrontier all;
  for (const CellFrontier& cell : cells) {
    classes[cell.density].add(cell);
    all.add(cell);
  }
  all.finish();
  double bytes = 0.0, sum = 0.0;
  const DensityFrontier* nearest = nullptr;  // Of those so far, for classes of which nothing was drawn.
  double before = 0.0;                       // Points of classes before the first that is known.
  for (std::size_t density = 0; density < kDensities; ++density) {
    classes[density].finish();
    if (classes[density].is_known()) nearest = &classes[density];
    sum += points[density];
    if (nearest == nullptr) {
      before += points[density];
    } else {
      bytes += (points[density] + std::exchange(before, 0.0)) * nearest->bytes_per_point();
    }
  }
  return sum > 0.0 && nearest != nullptr ? bytes / sum : all.bytes_per_point();
}

}  // namespace

double most_frontier_bytes_per_point(const SegmentParameters& parameters) {
  return kHeadBytes + kNeighbourBytes * static_cast<double>(parameters.most_neighbours());
}

double frontier_sample(std::uint64_t points) {
  const auto all = static_cast<double>(points);
  return std::clamp(std::max(0.01 * all, std::min(0.06 * all, 50'000.0)), 40'000.0, 300'000.0);
}

double frontier_bytes_per_point(const FrontierSamples& samples, std::span<const std::uint8_t> intensities,
                                const tiling::Survey& survey, const SegmentParameters& parameters) {
  CellDensities densities(samples.large, survey);
  std::vector<std::pair<CellSample::View, std::size_t>> cells;
  for (const CellSample::View& cell : samples.large.cells()) {
    const std::size_t density = density_of(cell.points->ids.size());
    if (density < kLeastDense || !densities.are_known()) cells.emplace_back(cell, density);
  }
  const PointsByDensity points = densities.points();
  for (const CellSample::View& cell : densities.are_known() ? samples.small.cells() : std::vector<CellSample::View>{}) {
    const std::size_t density = densities.at(cell.box);
    if (density >= kLeastDense) cells.emplace_back(cell, density);
  }
  std::vector<CellFrontier> found(cells.size());
  parallel_for_chunks(cells.size(), 1, [&](std::size_t i, std::size_t) {
    found[i] = frontier_of(cells[i].first, intensities, survey.lattice, parameters);
    found[i].density = cells[i].second;
  });
  std::uint64_t queries = 0;
  for (const CellFrontier& cell : found) queries += cell.proven >= kLeastCellQueries ? cell.proven : 0;
  if (queries < kLeastQueries) return kUsualShare * most_frontier_bytes_per_point(parameters);
  return kMargin * mean_bytes_per_point(found, points);
}

}  // namespace arris::pipeline
