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
SceneModel build_crossgable(const OptionValues& options, double spacing);
SceneModel build_mansard(const OptionValues& options, double spacing);
SceneModel build_dormer(const OptionValues& options, double spacing);
SceneModel build_dome(const OptionValues& options, double spacing);
SceneModel build_parapet(const OptionValues& options, double spacing);
SceneModel build_roofs(const OptionValues& options, double spacing);
SceneModel build_columns(const OptionValues& options, double spacing);
SceneModel build_facade(const OptionValues& options, double spacing);
SceneModel build_sculpture(const OptionValues& options, double spacing);
SceneModel build_roundedge(const OptionValues& options, double spacing);
SceneModel build_corners(const OptionValues& options, double spacing);
SceneModel build_spray(const OptionValues& options, double spacing);
SceneModel build_town(const OptionValues& options, double spacing);

}  // namespace arris::synth
