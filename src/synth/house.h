#pragma once
/// @file Houses with gable or hip roofs, and the named edges that surveyors draw of them. Private to synth.

#include "synth/scene_model.h"

namespace arris::synth {

/// Roofs are sheets without thickness, so overhanging eaves are boundaries; without overhang and with walls they are
/// folds.
struct House {
  Vec3 centre;                 ///< Of the footprint, on the ground.
  double heading_turns = 0.0;  ///< Direction of the ridge, from x towards y.
  double length = 12.0;        ///< Along the ridge; above width for hip roofs.
  double width = 8.0;
  double eave_height = 5.0;  ///< Of the walls.
  double pitch_deg = 35.0;
  double overhang = 0.0;
  bool hip = false;
  bool walls = true;
  bool on_ground = true;  ///< There is ground around the walls: their feet are folds, not boundaries.
  int windows = 0;        ///< In each of the two long walls.
  double window_recess = 0.15;
};

/// Roles: ridge, hip, eave, gable (the sloping ends of a gable roof), soffit (wall under an overhang), wall_corner,
/// footing, window, reveal (the four short edges into the wall), pane.
void add_house(SceneModel& model, const House& house);

}  // namespace arris::synth
