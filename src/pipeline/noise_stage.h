#pragma once
/// @file Noise of a scan, from some small parts of it.

#include "pipeline/cell_sample.h"

namespace arris::pipeline {

/// In data units; features/segment/noise_estimate.h has what they are.
struct ScanNoise {
  double noise = 0.0;
  double least_spacing = 0.0;
};

/// Of cells that hold a few hundred points of a surface each, many of them with all their neighbours.
ScanNoise estimate_noise(const CellSample& sample, const Lattice& lattice);

constexpr double kNoiseSample = 200'000.0;  ///< Points.
constexpr double kNoiseCellSpacings = 8.0;

}  // namespace arris::pipeline
