#include "synth/scene_catalog.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "synth/airborne.h"
#include "synth/scene_builders.h"

namespace arris::synth {

namespace {

std::vector<SceneOption> house_options() {
  return with_airborne_options({{"length", 12.0, 1.0, 1000.0, "along the ridge, m"},
                                {"width", 8.0, 1.0, 1000.0, "across the ridge, m"},
                                {"eave", 5.0, 0.5, 100.0, "height of the walls, m"},
                                {"pitch", 35.0, 5.0, 80.0, "slope of the roof, degrees"},
                                {"overhang", 0.0, 0.0, 2.0, "of the roof over the walls, m"},
                                {"walls", 0.0, 0.0, 1.0, "1: with walls; 0: the roof alone, as seen from the air"},
                                {"ground", 0.0, 0.0, 1.0, "1: with the ground around the house"}});
}

/// Nothing is quiet: the scene is young enough for all of its options to be named in every truth.
std::vector<SceneOption> roofs_options() {
  std::vector<SceneOption> options =
      with_airborne_options({{"eave", 5.0, 3.0, 100.0, "height of the eaves over the ground, m"},
                             {"walls", 0.0, 0.0, 1.0, "1: with the walls of gable, hip and parapet"},
                             {"ground", 0.0, 0.0, 1.0, "1: with the ground between the roofs"}});
  for (SceneOption& option : options) option.quiet = false;
  for (SceneOption& option : options) {
    if (option.name == "tree") option.value = 1.0;
  }
  return options;
}

std::vector<SceneInfo> make_catalog() {
  return {
      {"block",
       "24 x 24 x 12 m box with a cylinder of 14 m diameter, 6 m tall, above and below",
       0.25,
       {{"cavity", 0.0, 0.0, 1.0, "1: the upper cylinder is a cavity in the box instead"}},
       build_block},
      {"plates",
       "two square plates of 10 m, one over the other, each with a round hole of 3 m diameter",
       0.1,
       {{"gap_spacings", 4.0, 0.1, 1000.0, "distance of the plates in point spacings"},
        {"offset", 2.5, 0.0, 5.0, "shift of the lower plate along x and y, m"}},
       build_plates},
      {"stairs",
       "straight stairs, 0.15 m rise and 0.30 m going",
       0.022,
       {{"steps", 10.0, 1.0, 1000.0, "number of steps"}, {"width", 2.0, 0.1, 100.0, "m"}},
       build_stairs},
      {"gable", "roof with two slopes", 0.25, house_options(), build_gable},
      {"hip", "roof with four slopes", 0.25, house_options(), build_hip},
      {"crossgable", "two roofs of equal height that cross, with four valleys; the roof alone", 0.25,
       with_airborne_options({{"length", 16.0, 1.0, 1000.0, "along the main ridge, m"},
                              {"cross_length", 14.0, 1.0, 1000.0, "along the other ridge, m"},
                              {"width", 7.0, 0.5, 500.0, "of both, across their ridges, m"},
                              {"pitch", 38.0, 5.0, 80.0, "degrees"}}),
       build_crossgable},
      {"mansard", "hip roof in two pitches; the roof alone", 0.25,
       with_airborne_options({{"length", 16.0, 1.0, 1000.0, "m"},
                              {"width", 11.0, 1.0, 1000.0, "at most the length, m"},
                              {"break", 3.0, 0.1, 100.0, "height at which the pitch changes, m"},
                              {"steep", 70.0, 20.0, 85.0, "pitch below, degrees"},
                              {"pitch", 25.0, 5.0, 80.0, "pitch above, degrees"}}),
       build_mansard},
      {"dormer", "gable roof with a dormer; without walls but those of the dormer", 0.2,
       with_airborne_options({{"length", 12.0, 1.0, 1000.0, "along the ridge, m"},
                              {"width", 10.0, 1.0, 1000.0, "across the ridge, m"},
                              {"pitch", 42.0, 5.0, 80.0, "degrees"},
                              {"dormer_width", 2.4, 0.1, 100.0, "m"},
                              {"dormer_wall", 1.4, 0.05, 100.0, "height of its front up to the eaves, m"}}),
       build_dormer},
      {"dome", "cap of a sphere on a square flat roof", 0.2,
       with_airborne_options({{"radius", 5.0, 0.1, 1000.0, "of the sphere, m"},
                              {"cut", 0.4, 0.0, 0.9, "height of the roof over the sphere's centre, in radii"}}),
       build_dome},
      {"parapet", "flat roof with a parapet, and the walls below it", 0.2,
       with_airborne_options({{"length", 14.0, 1.0, 1000.0, "m"},
                              {"width", 10.0, 1.0, 1000.0, "m"},
                              {"height", 0.9, 0.01, 10.0, "of the parapet over the roof, m"},
                              {"thickness", 0.4, 0.01, 0.49, "of the parapet, m"},
                              {"walls", 1.0, 0.0, 1.0, "0: without any walls, as seen from the air", true}}),
       build_parapet},
      {"roofs", "all seven roofs above beside each other, with trees: what an airborne scanner sees of a settlement",
       0.35, roofs_options(), build_roofs},
      {"columns",
       "columns of 0.3 to 1 m diameter on a base, under an entablature",
       0.03,
       {{"count", 5.0, 1.0, 100.0, "number of columns"}, {"height", 4.0, 0.1, 100.0, "of the columns, m"}},
       build_columns},
      {"facade", "wall with windows that are recessed by 5, 10, 15 and 20 cm", 0.02, {}, build_facade},
      {"sculpture",
       "three S-shaped bands on posts on three steps, a disc of 0.26 m within one",
       0.022,
       {},
       build_sculpture},
      {"roundedge",
       "a row of right-angled edges rounded with radii of 0 to 5 spacings; a fold along the middle of the round is "
       "truth "
       "up to 1 spacing",
       0.02,
       {{"arm", 1.0, 0.1, 100.0, "size of each of the two faces across the edge, m"},
        {"length", 2.0, 0.1, 100.0, "of each edge, m"}},
       build_roundedge},
      {"corners",
       "pyramids of 3, 4, 5 and 6 planes",
       0.05,
       {{"size", 2.0, 0.1, 100.0, "of the foot from its middle, m"}, {"height", 1.5, 0.05, 100.0, "m"}},
       build_corners},
      {"spray",
       "wall with stray points near it; no edge but its border",
       0.05,
       {{"size", 8.0, 0.1, 1000.0, "m"},
        {"share", 0.05, 0.0, 0.9, "of points that are stray"},
        {"reach", 0.5, 0.01, 100.0, "farthest distance of stray points, m"}},
       build_spray},
      {"dihedral",
       "a row of straight folds with interior angles of 30 to 170 degrees in steps of 10",
       0.05,
       {{"arm", 2.0, 0.1, 100.0, "size of each of the two faces across the fold, m"},
        {"length", 4.0, 0.1, 100.0, "of each fold, m"}},
       build_dihedral},
      {"plane",
       "a square plane; no folds, and no boundary but its border",
       0.1,
       {{"size", 10.0, 0.001, 1e6, "m"}},
       build_plane},
      {"sphere", "a sphere; no edges at all", 0.1, {{"radius", 5.0, 0.001, 1e6, "m"}}, build_sphere},
      {"noise",
       "a cube filled with random points; no edges at all",
       0.1,
       {{"size", 4.0, 0.001, 1e6, "m"}},
       build_noise},
      {"town",
       "houses, columns and walls around a street, scanned from tripods: occlusion, density falling with range",
       0.01,
       {{"stations", 4.0, 1.0, 8.0, "number of scanner positions"},
        {"mixed_pixels", 0.0, 0.0, 1.0,
         "share of the beams across a depth edge that return a point between both depths; a beam is half a step wide"},
        {"registration", 0.0, 0.0, 1.0, "standard deviation of each station's position error per axis, m"},
        {"windows", 1.0, 0.0, 1.0, "1: houses have recessed windows"}},
       build_town},
  };
}

template <class Items>
std::string names(const Items& items) {
  std::string text;
  for (const auto& item : items) text += (text.empty() ? "" : ", ") + item.name;
  return text.empty() ? "none" : text;
}

}  // namespace

std::span<const SceneInfo> list_scenes() {
  static const std::vector<SceneInfo> catalog = make_catalog();
  return catalog;
}

const SceneInfo& find_scene(std::string_view name) {
  for (const SceneInfo& scene : list_scenes()) {
    if (scene.name == name) return scene;
  }
  throw ConfigError("unknown scene \"" + printable(name) + "\"; the scenes are " + names(list_scenes()));
}

OptionValues resolve_options(const SceneInfo& scene, const std::map<std::string, double>& given) {
  OptionValues values;
  for (const SceneOption& option : scene.options) values[option.name] = option.value;
  for (const auto& [name, value] : given) {
    const auto found = values.find(name);
    if (found == values.end()) {
      throw ConfigError(fmt::format("scene {} has no option \"{}\"; its options are: {}", scene.name, printable(name),
                                    names(scene.options)));
    }
    found->second = value;
  }
  for (const SceneOption& option : scene.options) {
    const double value = values[option.name];
    if (!(value >= option.min && value <= option.max)) {
      throw ConfigError(fmt::format("option {} of scene {} is {}; it must be from {} to {}", option.name, scene.name,
                                    value, option.min, option.max));
    }
  }
  return values;
}

}  // namespace arris::synth
