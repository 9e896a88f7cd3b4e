#pragma once
/// @file How many points a scene asks for. Private to synth.

#include "synth/point_units.h"
#include "synth/scene_model.h"

namespace arris::synth {

/// Share of the full density at a place of a gradient, which goes along x: the local spacing grows linearly.
/// @param bounds  of the scene. In [0.1, 1].
double gradient_share_at(const Box3& bounds, const Vec3& position);

/// True if points are counted per spacing³.
bool is_volume(const SceneModel& model);

/// What the number of points is proportional to: squares, or cubes, of the spacing.
double weighted_measure(const SceneModel& model, Sampling sampling);

}  // namespace arris::synth
