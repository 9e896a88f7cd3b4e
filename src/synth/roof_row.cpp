/// @file All roofs beside each other, for one run that judges them all.

#include <array>

#include "synth/airborne.h"
#include "synth/scene_builders.h"

namespace arris::synth {

namespace {

constexpr double kPitchX = 27.0, kPitchY = 25.0, kGroundAround = 8.0;
constexpr double kParapetFoot = 3.0;  // Below its roof, if it has walls.
const Material kMeadow{0.4, kGroundClass, 0x7000, 0x7c00, 0x5000};

struct Plot {
  const char* scene;
  int column, row;
};
constexpr std::array<Plot, 7> kPlots{{{"gable", 0, 0},
                                      {"hip", 1, 0},
                                      {"crossgable", 2, 0},
                                      {"mansard", 3, 0},
                                      {"dormer", 0, 1},
                                      {"dome", 1, 1},
                                      {"parapet", 2, 1}}};

std::vector<Vec3> ring(const Box3& box) {
  return {{box.min.x, box.min.y, 0}, {box.max.x, box.min.y, 0}, {box.max.x, box.max.y, 0}, {box.min.x, box.max.y, 0}};
}

Box3 roof_bounds(const SceneModel& roof) {
  Box3 box;
  for (const Face& face : roof.faces) {
    if (face.shape != Face::Shape::kVolume) box.include(face.bounds());
  }
  return box;
}

/// Ground where no roof hides it from above. Walls stand on it.
void add_ground(SceneModel& model, const std::vector<Box3>& roofs) {
  const Box3 all = model.bounds();
  const Vec3 low{all.min.x - kGroundAround, all.min.y - kGroundAround, 0};
  const Vec3 high{all.max.x + kGroundAround, all.max.y + kGroundAround, 0};
  Face& ground = model.rectangle(low, {high.x, low.y, 0}, {low.x, high.y, 0}, kMeadow);
  model.loop(EdgeKind::kBoundary, "ground_border", ring({low, high}));
  for (const Box3& roof : roofs) {
    ground.rect_holes.push_back({{roof.min.x - low.x, roof.min.y - low.y}, {roof.max.x - low.x, roof.max.y - low.y}});
    if (roof.min.z > 0.0) model.loop(EdgeKind::kBoundary, "shadow", ring(roof));
  }
  for (TruthEdge& edge : model.edges) {
    if (edge.role != "foot" && edge.role != "footing") continue;
    edge.kind = EdgeKind::kConcave;
    edge.angle_deg = 90.0;
  }
}

}  // namespace

SceneModel build_roofs(const OptionValues& options, double spacing) {
  SceneModel model;
  std::vector<Box3> roofs;
  for (const Plot& plot : kPlots) {
    const SceneInfo& scene = find_scene(plot.scene);
    OptionValues own = resolve_options(scene, {});
    const bool house = own.count("eave") > 0;
    if (house) own["eave"] = options.at("eave");
    if (own.count("walls") > 0) own["walls"] = options.at("walls");
    for (const SceneOption& option : airborne_options()) own[option.name] = options.at(option.name);
    SceneModel roof = scene.build(own, spacing);
    const Box3 box = roof_bounds(roof);
    const bool on_its_walls = box.min.z < 0.0;
    const double lift = house ? 0.0 : on_its_walls ? kParapetFoot : options.at("eave");
    const Vec3 place{kPitchX * plot.column, kPitchY * plot.row, lift};
    roofs.push_back({box.min + place, box.max + place});
    for (Face& face : roof.faces) {
      if (face.material.classification != kTreeClass) face.material.classification = kBuildingClass;
    }
    add_moved(model, roof, place);
  }
  model.intensity_noise = options.at("intensity_noise");
  if (options.at("ground") != 0.0) add_ground(model, roofs);
  return model;
}

}  // namespace arris::synth
