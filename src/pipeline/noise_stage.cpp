#include "pipeline/noise_stage.h"

#include "features/segment/noise_estimate.h"

namespace arris::pipeline {

ScanNoise estimate_noise(const CellSample& sample, const Lattice& lattice) {
  NoiseEstimate estimate;
  sample.for_each([&](const LatticeBox& box, const CellSample::Cell& cell) { estimate.add(cell.positions, box); });
  return {estimate.noise() * lattice.step, estimate.least_spacing() * lattice.step};
}

}  // namespace arris::pipeline
