#pragma once
/// @file Noise of a scan, from some small parts of it.

#include "core/cancel.h"
#include "core/progress.h"
#include "io/point_source.h"
#include "tiling/survey.h"

namespace arris::pipeline {

/// In data units; features/segment/noise_estimate.h has what they are.
struct ScanNoise {
  double noise = 0.0;
  double least_spacing = 0.0;
};

/// Reads the inputs once and keeps the points of some absolute cells, drawn by a hash of their place: about
/// kNoiseSample points, so that nothing depends on tiles, budget or order.
ScanNoise estimate_noise(io::InputSet& inputs, const tiling::Survey& survey, ProgressSink& progress,
                         const CancelToken& cancel);

constexpr double kNoiseSample = 200'000.0;

}  // namespace arris::pipeline
