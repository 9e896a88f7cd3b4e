#include "synth/scene_catalog.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "synth/scene_builders.h"

namespace arris::synth {

namespace {

std::vector<SceneOption> house_options() {
  return {{"length", 12.0, 1.0, 1000.0, "along the ridge, m"},
          {"width", 8.0, 1.0, 1000.0, "across the ridge, m"},
          {"eave", 5.0, 0.5, 100.0, "height of the walls, m"},
          {"pitch", 35.0, 5.0, 80.0, "slope of the roof, degrees"},
          {"overhang", 0.0, 0.0, 2.0, "of the roof over the walls, m"},
          {"walls", 0.0, 0.0, 1.0, "1: with walls; 0: the roof alone, as seen from the air"},
          {"ground", 0.0, 0.0, 1.0, "1: with the ground around the house"}};
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
