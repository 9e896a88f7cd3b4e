#pragma once
/// @file The scenes that exist, their options and defaults.

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "synth/scene_model.h"

namespace arris::synth {

struct SceneOption {
  std::string name;
  double value = 0.0;  ///< Default.
  double min = 0.0, max = 0.0;
  std::string description;
  bool quiet = false;  ///< Not among the properties of the truth while it has its default.
};

/// Values of all options of a scene by name.
using OptionValues = std::map<std::string, double>;

struct SceneInfo {
  std::string name;
  std::string description;
  double spacing =
      0.0;  ///< Default point spacing, metres; scanned scenes: on a surface that faces the scanner at 10 m.
  std::vector<SceneOption> options;
  /// @param spacing  for lengths that are given in spacings.
  SceneModel (*build)(const OptionValues& options, double spacing) = nullptr;
};

/// In the order in which they should be shown. The span lives as long as the program.
std::span<const SceneInfo> list_scenes();

/// Throws ConfigError that names the scenes.
const SceneInfo& find_scene(std::string_view name);

/// Defaults with `given` on top. Throws ConfigError for unknown names and values out of range.
OptionValues resolve_options(const SceneInfo& scene, const std::map<std::string, double>& given);

}  // namespace arris::synth
