#include "pipeline/noise_stage.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "features/segment/noise_estimate.h"
#include "tiling/lattice_mapper.h"

namespace arris::pipeline {
namespace {

/// Side of a cell: it holds a few hundred points of a surface, many of them with all their neighbours.
constexpr double kCellSpacings = 8.0;

/// Cells with more say nothing: one heap of points must not take the memory.
constexpr std::size_t kMostCellPoints = 200'000;

/// splitmix64 of the cell's place.
std::uint64_t hash_of(std::int64_t x, std::int64_t y, std::int64_t z) {
  std::uint64_t h = 0;
  for (const std::int64_t c : {x, y, z}) {
    h += static_cast<std::uint64_t>(c) + 0x9e3779b97f4a7c15U;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9U;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebU;
    h ^= h >> 31;
  }
  return h;
}

/// Absolute cells. Their faces lie off round coordinates, where floors and walls of drawn models are: planes in a face
/// have all their points near the end of what is seen.
struct SampleGrid {
  int shift;

  std::int64_t offset() const { return (std::int64_t{1} << shift) * 3 / 8; }
  LatticePoint cell_of(const LatticePoint& p) const {
    const auto cell = [this](std::int32_t c) { return static_cast<std::int32_t>((c + offset()) >> shift); };
    return {cell(p.x), cell(p.y), cell(p.z)};
  }
  LatticeBox box_of(const LatticePoint& cell) const {
    LatticeBox box;
    for (int axis = 0; axis < 3; ++axis) {
      box.min[axis] = (std::int64_t{cell[axis]} << shift) - offset();
      box.max[axis] = box.min[axis] + (std::int64_t{1} << shift);
    }
    return box;
  }
};

}  // namespace

ScanNoise estimate_noise(io::InputSet& inputs, const tiling::Survey& survey, ProgressSink& progress,
                         const CancelToken& cancel) {
  progress.phase("noise", inputs.points());
  const double side_steps = std::max(kCellSpacings * survey.spacing / survey.lattice.step, 8.0);
  const SampleGrid grid{std::min(30, static_cast<int>(std::ceil(std::log2(side_steps))))};
  const double share = std::min(1.0, kNoiseSample / std::max<double>(1.0, static_cast<double>(survey.points())));
  const auto limit = static_cast<std::uint64_t>(share * 4294967295.0);
  const tiling::LatticeMapper mapper(inputs.sources(), survey.lattice);
  std::map<LatticePoint, std::vector<LatticePoint>> cells;
  io::PointBatch batch;
  std::vector<LatticePoint> positions;
  std::vector<tiling::Mapped> outcome;
  LatticePoint last_cell{INT32_MIN, 0, 0};
  bool last_drawn = false;
  inputs.rewind();
  while (inputs.read(batch, {})) {
    cancel.check();
    mapper.map(batch, inputs.source_index(), positions, outcome);
    for (std::size_t i = 0; i < batch.count; ++i) {
      if (outcome[i] != tiling::Mapped::kOk) continue;
      const LatticePoint cell = grid.cell_of(positions[i]);
      if (cell != last_cell) {
        last_cell = cell;
        last_drawn = (hash_of(cell.x, cell.y, cell.z) >> 32) <= limit;
      }
      if (!last_drawn) continue;
      std::vector<LatticePoint>& here = cells[cell];
      if (here.size() <= kMostCellPoints) here.push_back(positions[i]);
    }
    progress.advance(batch.count);
  }
  NoiseEstimate estimate;
  for (const auto& [cell, points] : cells) {
    if (points.size() > kMostCellPoints) continue;
    estimate.add(points, grid.box_of(cell));
  }
  return {estimate.noise() * survey.lattice.step, estimate.least_spacing() * survey.lattice.step};
}

}  // namespace arris::pipeline
