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
constexpr double kCellSpacings = 24.0;

/// Cells with more say nothing: one heap of points must not take the memory.
constexpr std::size_t kMostCellPoints = 20'000;

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

}  // namespace

double estimate_noise(io::InputSet& inputs, const tiling::Survey& survey, ProgressSink& progress,
                      const CancelToken& cancel) {
  progress.phase("noise", inputs.points());
  const double side_steps = std::max(kCellSpacings * survey.spacing / survey.lattice.step, 8.0);
  const int shift = std::min(30, static_cast<int>(std::ceil(std::log2(side_steps))));
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
      const LatticePoint cell{positions[i].x >> shift, positions[i].y >> shift, positions[i].z >> shift};
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
    LatticeBox box;
    for (int axis = 0; axis < 3; ++axis) {
      box.min[axis] = std::int64_t{cell[axis]} << shift;
      box.max[axis] = box.min[axis] + (std::int64_t{1} << shift);
    }
    estimate.add(points, box);
  }
  return estimate.noise_over_spacing();
}

}  // namespace arris::pipeline
