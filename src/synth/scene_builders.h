#pragma once
/// @file One function per scene. Lengths in metres, z up. Private to synth; the catalogue names and describes them.

#include "synth/scene_catalog.h"

namespace arris::synth {

SceneModel build_block(const OptionValues& options, double spacing);
SceneModel build_plates(const OptionValues& options, double spacing);
SceneModel build_stairs(const OptionValues& options, double spacing);
SceneModel build_dihedral(const OptionValues& options, double spacing);
SceneModel build_plane(const OptionValues& options, double spacing);
SceneModel build_sphere(const OptionValues& options, double spacing);
SceneModel build_noise(const OptionValues& options, double spacing);
SceneModel build_gable(const OptionValues& options, double spacing);
SceneModel build_hip(const OptionValues& options, double spacing);
SceneModel build_town(const OptionValues& options, double spacing);

}  // namespace arris::synth
