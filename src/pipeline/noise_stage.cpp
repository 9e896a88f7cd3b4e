#include "pipeline/noise_stage.h"

#include <vector>

#include "core/parallel.h"
#include "features/segment/noise_estimate.h"

namespace arris::pipeline {

ScanNoise estimate_noise(const CellSample& sample, const Lattice& lattice) {
  const std::vector<CellSample::View> cells = sample.cells();
  std::vector<NoiseEstimate> of_cells(cells.size());
  parallel_for_chunks(cells.size(), 1,
                      [&](std::size_t i, std::size_t) { of_cells[i].add(cells[i].points->positions, cells[i].box); });
  NoiseEstimate estimate;
  for (const NoiseEstimate& of_cell : of_cells) estimate.add(of_cell);
  return {estimate.noise() * lattice.step, estimate.least_spacing() * lattice.step};
}

}  // namespace arris::pipeline
