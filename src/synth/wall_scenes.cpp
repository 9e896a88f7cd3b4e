#include <array>

#include "synth/airborne.h"
#include "synth/deterministic_math.h"
#include "synth/mesh.h"
#include "synth/scene_builders.h"

namespace arris::synth {

namespace {

const Material kWall{0.7, 6, 0xd800, 0xd000, 0xc000};
const Material kGravel{0.4, 6, 0x7000, 0x6c00, 0x6800};
const Material kGlass{0.15, 6, 0x5000, 0x6000, 0x7800};

std::vector<Vec3> rectangle_at(double x, double y, double z) {
  return {{-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z}};
}

void add_band(SceneModel& model, const std::vector<Vec3>& low, const std::vector<Vec3>& high, EdgeKind corners,
              const std::string& role, const Material& material) {
  for (std::size_t i = 0; i < 4; ++i) {
    model.rectangle(low[i], low[(i + 1) % 4], high[i], material);
    model.segment(corners, role, low[i], high[i], 90.0);
  }
}

}  // namespace

SceneModel build_parapet(const OptionValues& options, double /*spacing*/) {
  constexpr double kBelow = 3.0;
  const double x = 0.5 * options.at("length"), y = 0.5 * options.at("width");
  const double t = options.at("thickness"), h = options.at("height");
  SceneModel model;
  const auto foot = rectangle_at(x, y, -kBelow), outer = rectangle_at(x, y, h);
  const auto inner = rectangle_at(x - t, y - t, h), floor = rectangle_at(x - t, y - t, 0.0);
  const bool walls = options.at("walls") != 0.0;
  if (walls) {
    add_band(model, foot, outer, EdgeKind::kConvex, "wall_corner", kWall);
    add_band(model, floor, inner, EdgeKind::kConcave, "parapet_corner", kWall);
  }
  model.rectangle(outer[0], outer[1], outer[3], kWall).rect_holes = {{{t, t}, {2.0 * x - t, 2.0 * y - t}}};
  model.rectangle(floor[0], floor[1], floor[3], kGravel);
  // Without the walls between them, level and parapet end where they met them.
  const double angle_deg = walls ? 90.0 : 0.0;
  const EdgeKind top = walls ? EdgeKind::kConvex : EdgeKind::kBoundary;
  if (walls) model.loop(EdgeKind::kBoundary, "foot", foot);
  model.loop(top, "parapet", outer, angle_deg);
  model.loop(top, "parapet", inner, angle_deg);
  model.loop(walls ? EdgeKind::kConcave : EdgeKind::kBoundary, "roof_border", floor, angle_deg);
  add_airborne(model, options);
  return model;
}

SceneModel build_facade(const OptionValues& /*options*/, double /*spacing*/) {
  constexpr std::array<double, 4> kRecesses{0.05, 0.10, 0.15, 0.20};
  constexpr double kPitch = 2.4, kStorey = 3.0, kWidth = 1.2, kHeight = 1.6, kSill = 0.9;
  constexpr int kStoreys = 2;
  SceneModel model;
  const double width = kPitch * kRecesses.size(), height = kStorey * kStoreys;
  const std::size_t wall = model.faces.size();
  model.rectangle({0, 0, 0}, {width, 0, 0}, {0, 0, height}, kWall);
  model.loop(EdgeKind::kBoundary, "border", {{0, 0, 0}, {width, 0, 0}, {width, 0, height}, {0, 0, height}});
  for (int storey = 0; storey < kStoreys; ++storey) {
    for (std::size_t i = 0; i < kRecesses.size(); ++i) {
      const double x0 = kPitch * (static_cast<double>(i) + 0.5) - 0.5 * kWidth, x1 = x0 + kWidth;
      const double z0 = kStorey * storey + kSill, z1 = z0 + kHeight;
      model.faces[wall].rect_holes.push_back({{x0, z0}, {x1, z1}});
      const auto at = [&](double y) { return std::vector<Vec3>{{x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1}}; };
      const auto front = at(0.0), back = at(kRecesses[i]);
      add_band(model, front, back, EdgeKind::kConcave, "reveal", kWall);
      model.rectangle(back[0], back[1], back[3], kGlass);
      model.loop(EdgeKind::kConvex, "window", front, 90.0);
      model.loop(EdgeKind::kConcave, "pane", back, 90.0);
    }
  }
  return model;
}

SceneModel build_roundedge(const OptionValues& options, double spacing) {
  constexpr std::array<double, 9> kRadii{0.0, 0.25, 0.5, 0.75, 1.0, 2.0, 3.0, 4.0, 5.0};  // In spacings.
  constexpr double kSharpest = 1.0;
  const double arm = options.at("arm"), length = options.at("length");
  SceneModel model;
  for (std::size_t i = 0; i < kRadii.size(); ++i) {
    const double x = 3.0 * arm * static_cast<double>(i), r = kRadii[i] * spacing;
    const std::string role = "radius_" + std::to_string(static_cast<int>(kRadii[i] * 100.0));
    const Vec3 along{0, length, 0};
    // A level plane on the left, an upright one on the right, tangent to the round between them.
    const Vec3 level{x - r, 0, 0}, upright{x, 0, -r}, level_end{x - arm, 0, 0}, upright_end{x, 0, -arm};
    model.rectangle(level_end, level, level_end + along, kWall);
    model.rectangle(upright, upright_end, upright + along, kGravel);
    for (const auto& [near, far] : {std::pair{level, level_end}, std::pair{upright, upright_end}}) {
      model.segment(EdgeKind::kBoundary, role, near, far);
      model.segment(EdgeKind::kBoundary, role, near + along, far + along);
      model.segment(EdgeKind::kBoundary, role, far, far + along);
    }
    const Vec3 centre{x - r, 0, -r};
    if (r > 0.0) {
      model.cylinder_part(centre, along, {0, 0, r}, 0.25, kWall);
      for (const Vec3& end : {centre, centre + along}) {
        model.arc(EdgeKind::kRimBoundary, role, end, {0, 1, 0}, {0, 0, r}, 90.0, 0.0);
      }
    }
    if (kRadii[i] > kSharpest) continue;
    const SinCos eighth = sin_cos_turns(0.125);
    const Vec3 middle = centre + Vec3{r * eighth.sin, 0, r * eighth.cos};
    model.segment(EdgeKind::kConvex, role, middle, middle + along, 90.0);
  }
  return model;
}

SceneModel build_corners(const OptionValues& options, double /*spacing*/) {
  const double size = options.at("size"), height = options.at("height");
  SceneModel model;
  for (std::size_t planes = 3; planes <= 6; ++planes) {
    const double x = 3.0 * size * static_cast<double>(planes - 3);
    Mesh mesh;
    mesh.corners = {{x, 0, height}};
    for (std::size_t i = 0; i < planes; ++i) {
      const SinCos turn = sin_cos_turns(static_cast<double>(i) / static_cast<double>(planes));
      mesh.corners.push_back({x + size * turn.cos, size * turn.sin, 0});
      mesh.polygons.push_back({0, 1 + i, 1 + (i + 1) % planes});
    }
    const std::string role = "corner_" + std::to_string(planes);
    add_mesh(model, mesh, kWall, {"foot", role, role, role});
  }
  return model;
}

SceneModel build_spray(const OptionValues& options, double /*spacing*/) {
  const double size = options.at("size");
  SceneModel model;
  model.rectangle({0, 0, 0}, {size, 0, 0}, {0, 0, size}, kWall);
  model.loop(EdgeKind::kBoundary, "border", {{0, 0, 0}, {size, 0, 0}, {size, 0, size}, {0, 0, size}});
  model.spray_share = options.at("share");
  model.spray_reach = options.at("reach");
  return model;
}

}  // namespace arris::synth
