#pragma once
/// @file Noise of a scan against its spacing, from some small parts of it.

#include "core/cancel.h"
#include "core/progress.h"
#include "io/point_source.h"
#include "tiling/survey.h"

namespace arris::pipeline {

/// Reads the inputs once and keeps the points of some absolute cells, drawn by a hash of their place: about
/// kNoiseSample points, so that nothing depends on tiles, budget or order. @return features/segment/noise_estimate.h.
double estimate_noise(io::InputSet& inputs, const tiling::Survey& survey, ProgressSink& progress,
                      const CancelToken& cancel);

constexpr double kNoiseSample = 100'000.0;

}  // namespace arris::pipeline
