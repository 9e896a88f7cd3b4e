#pragma once
/// @file What an airborne scan of a roof has besides the roof: a tree at the eave, roofing of two materials, and
/// intensities that scatter. Private to synth.

#include "synth/scene_catalog.h"

namespace arris::synth {

/// The options of every roof, all off by default: tree, materials, intensity_noise.
std::vector<SceneOption> airborne_options();
/// `own` with airborne_options() behind them.
std::vector<SceneOption> with_airborne_options(std::vector<SceneOption> own);

/// Does to a finished roof what the options ask for; nothing by default.
///
/// tree: a crown, the ellipsoid of kCrownRadius and kCrownHalfHeight, that reaches kCrownOverlap over the middle of the
/// longest level eave; its points are random in it, of class 5 and on no surface. They reflect as the roof does, so
/// that only their places tell them from it. materials: beyond an upright plane across the x axis, 0.15 of the roof's
/// length from its middle, everything reflects half as much. Planes without holes are cut there, and both parts are
/// surfaces of their own; other faces belong whole to the side that their middle is on. Ground (class 2) stays as it
/// is. Faces without a class become buildings (6) if there is a tree.
void add_airborne(SceneModel& model, const OptionValues& options);

/// Adds the faces and edges of `part`, moved.
void add_moved(SceneModel& model, const SceneModel& part, const Vec3& shift);

inline constexpr double kCrownRadius = 2.0, kCrownHalfHeight = 2.5, kCrownOverlap = 0.3;  // Metres.
inline constexpr std::uint8_t kGroundClass = 2, kTreeClass = 5, kBuildingClass = 6;       // ASPRS codes.

}  // namespace arris::synth
