#include <cmath>

#include "synth/deterministic_math.h"
#include "synth/scene_builders.h"

namespace arris::synth {

namespace {

const Material kStone{0.5, 1, 0xb400, 0xac00, 0xa000};
const Material kMetal{0.35, 1, 0x6000, 0x6800, 0x7400};
const Material kWood{0.6, 1, 0xb000, 0x8000, 0x4c00};

/// The twelve edges of an upright box; the faces are the caller's.
void box_edges(SceneModel& model, const Vec3& low, const Vec3& high) {
  for (const double z : {low.z, high.z}) {
    model.loop(EdgeKind::kConvex, "box",
               {{low.x, low.y, z}, {high.x, low.y, z}, {high.x, high.y, z}, {low.x, high.y, z}}, 90.0);
  }
  for (const double x : {low.x, high.x}) {
    for (const double y : {low.y, high.y}) model.segment(EdgeKind::kConvex, "box", {x, y, low.z}, {x, y, high.z}, 90.0);
  }
}

}  // namespace

SceneModel build_block(const OptionValues& options, double /*spacing*/) {
  constexpr double kSide = 24.0, kHeight = 12.0, kRadius = 7.0, kTall = 6.0, kMiddle = 0.5 * kSide;
  const bool cavity = options.at("cavity") != 0.0;
  SceneModel model;
  for (const double z : {0.0, kHeight}) {
    model.rectangle({0, 0, z}, {kSide, 0, z}, {0, kSide, z}, kStone).circle_holes = {{{kMiddle, kMiddle}, kRadius}};
  }
  for (const double at : {0.0, kSide}) {
    model.rectangle({0, at, 0}, {kSide, at, 0}, {0, at, kHeight}, kStone);
    model.rectangle({at, 0, 0}, {at, kSide, 0}, {at, 0, kHeight}, kStone);
  }
  box_edges(model, {0, 0, 0}, {kSide, kSide, kHeight});
  const Vec3 up{0, 0, 1};
  const auto round_part = [&](double from, double to, bool hollow) {
    const Vec3 base{kMiddle, kMiddle, std::min(from, to)};
    model.cylinder(base, up, kTall, kRadius, kMetal);
    model.disc({kMiddle, kMiddle, to}, up, kRadius, kMetal);
    model.circle(hollow ? EdgeKind::kRimConcave : EdgeKind::kRimConvex, "cylinder", {kMiddle, kMiddle, to}, up, kRadius,
                 90.0);
    model.circle(hollow ? EdgeKind::kRimConvex : EdgeKind::kRimConcave, "joint", {kMiddle, kMiddle, from}, up, kRadius,
                 90.0);
  };
  round_part(kHeight, cavity ? kHeight - kTall : kHeight + kTall, cavity);
  round_part(0.0, -kTall, false);
  return model;
}

SceneModel build_plates(const OptionValues& options, double spacing) {
  constexpr double kSide = 10.0, kHole = 1.5, kMiddle = 0.5 * kSide;
  const double gap = options.at("gap_spacings") * spacing;
  SceneModel model;
  for (const bool upper : {true, false}) {
    const double at = upper ? 0.0 : options.at("offset");
    const double z = upper ? gap : 0.0;
    const Vec3 a{at, at, z}, b{at + kSide, at, z}, c{at + kSide, at + kSide, z}, d{at, at + kSide, z};
    model.rectangle(a, b, d, upper ? kMetal : kWood).circle_holes = {{{kMiddle, kMiddle}, kHole}};
    model.loop(EdgeKind::kBoundary, upper ? "upper" : "lower", {a, b, c, d});
    model.circle(EdgeKind::kRimBoundary, upper ? "upper_hole" : "lower_hole", {at + kMiddle, at + kMiddle, z},
                 {0, 0, 1}, kHole);
  }
  return model;
}

SceneModel build_stairs(const OptionValues& options, double /*spacing*/) {
  constexpr double kRise = 0.15, kGoing = 0.30;
  const int steps = static_cast<int>(std::floor(options.at("steps")));
  const double width = options.at("width");
  SceneModel model;
  for (int i = 0; i < steps; ++i) {
    const double x = i * kGoing, next_x = (i + 1) * kGoing;
    const double z = i * kRise, next_z = (i + 1) * kRise;
    model.rectangle({x, 0, z}, {x, width, z}, {x, 0, next_z}, kStone);
    model.rectangle({x, 0, next_z}, {next_x, 0, next_z}, {x, width, next_z}, kStone);
    model.segment(EdgeKind::kConvex, "nosing", {x, 0, next_z}, {x, width, next_z}, 90.0);
    if (i > 0) {
      model.segment(EdgeKind::kConcave, "inner_corner", {x, 0, z}, {x, width, z}, 90.0);
    } else {
      model.segment(EdgeKind::kBoundary, "foot", {x, 0, z}, {x, width, z});
    }
    if (i + 1 == steps) model.segment(EdgeKind::kBoundary, "landing", {next_x, 0, next_z}, {next_x, width, next_z});
    for (const double y : {0.0, width}) {
      model.segment(EdgeKind::kBoundary, "side", {x, y, z}, {x, y, next_z});
      model.segment(EdgeKind::kBoundary, "side", {x, y, next_z}, {next_x, y, next_z});
    }
  }
  return model;
}

SceneModel build_dihedral(const OptionValues& options, double /*spacing*/) {
  constexpr int kFirstDeg = 30, kLastDeg = 170, kStepDeg = 10;
  const double arm = options.at("arm"), length = options.at("length");
  SceneModel model;
  for (int angle = kFirstDeg; angle <= kLastDeg; angle += kStepDeg) {
    const double x = (angle - kFirstDeg) / kStepDeg * 3.0 * arm;
    const SinCos half = sin_cos_turns(angle / 720.0);
    const std::string role = "fold_" + std::to_string(angle);
    const Vec3 a{x, 0, 0}, b{x, length, 0};
    model.segment(EdgeKind::kConvex, role, a, b, angle);
    for (const double side : {-1.0, 1.0}) {
      const Vec3 across{side * arm * half.sin, 0, -arm * half.cos};
      model.rectangle(a, b, a + across, side < 0 ? kWood : kMetal);
      model.segment(EdgeKind::kBoundary, role, a, a + across);
      model.segment(EdgeKind::kBoundary, role, a + across, b + across);
      model.segment(EdgeKind::kBoundary, role, b + across, b);
    }
  }
  return model;
}

SceneModel build_plane(const OptionValues& options, double /*spacing*/) {
  const double size = options.at("size");
  SceneModel model;
  model.rectangle({0, 0, 0}, {size, 0, 0}, {0, size, 0}, kStone);
  model.loop(EdgeKind::kBoundary, "border", {{0, 0, 0}, {size, 0, 0}, {size, size, 0}, {0, size, 0}});
  return model;
}

SceneModel build_sphere(const OptionValues& options, double /*spacing*/) {
  SceneModel model;
  Face& face = model.faces.emplace_back();
  face.shape = Face::Shape::kSphere;
  face.radius = options.at("radius");
  face.material = kStone;
  return model;
}

SceneModel build_noise(const OptionValues& options, double /*spacing*/) {
  SceneModel model;
  Face& face = model.faces.emplace_back();
  face.shape = Face::Shape::kVolume;
  face.size_u = face.size_v = face.size_w = options.at("size");
  face.material = kStone;
  return model;
}

}  // namespace arris::synth
