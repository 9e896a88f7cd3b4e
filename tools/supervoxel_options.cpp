#include "supervoxel_options.h"

#include <CLI/CLI.hpp>

#include "run_options.h"

namespace arris::tools {

void add_supervoxel_options(CLI::App& verb, SupervoxelOptions& o, const std::string& group) {
  SupervoxelParameters& p = o.parameters;
  const auto number = [&](const char* name, auto& value, const char* what) {
    verb.add_option(name, value, what)->group(group)->capture_default_str();
  };
  verb.add_option("--voxel", o.voxel, "Side of a voxel (length; default 1.5 spacings)")->group(group);
  verb.add_option("--seed", o.seed, "Side of a seed cell: the size of supervoxels (length; default 8 voxels)")
      ->group(group);
  verb.add_option("--features", o.features,
                  "normal: normals, space and colour; fpfh: point feature histograms, eq. (2) as published")
      ->check(CLI::IsMember({"fpfh", "normal"}))
      ->group(group)
      ->capture_default_str();
  verb.add_option("--colour", o.colour, "auto: colours take part if all inputs have them; on; off")
      ->check(CLI::IsMember({"auto", "on", "off"}))
      ->group(group)
      ->capture_default_str();
  number("--iterations", p.iterations, "Rounds of growth; centres move between them");
  number("--seed-support", p.seed_support,
         "Seeds with less than this share of a full disc of voxels around are dropped");
  number("--lambda", p.lambda, "fpfh: weight of colour");
  number("--mu", p.mu, "fpfh: weight of space");
  number("--epsilon", p.epsilon, "fpfh: weight of the histograms");
  number("--colour-scale", p.colour_scale, "fpfh: m of eq. (2), in CIELab units");
  number("--normal-weight", p.normal_weight, "normal: weight of the normals");
  number("--spatial-weight", p.spatial_weight, "normal: weight of space");
  number("--colour-weight", p.colour_weight, "normal: weight of colour");
}

SupervoxelParameters to_parameters(const SupervoxelOptions& o) {
  SupervoxelParameters p = o.parameters;
  p.voxel = length_or(o.voxel, 0.0);
  p.seed = length_or(o.seed, 0.0);
  p.features = o.features == "normal" ? SupervoxelParameters::Features::kNormal : SupervoxelParameters::Features::kFpfh;
  p.colour = o.colour == "on"    ? SupervoxelParameters::Colour::kOn
             : o.colour == "off" ? SupervoxelParameters::Colour::kOff
                                 : SupervoxelParameters::Colour::kAuto;
  return p;
}

}  // namespace arris::tools
