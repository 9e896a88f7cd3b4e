#include "synth/house.h"

#include "core/error.h"
#include "synth/airborne.h"
#include "synth/deterministic_math.h"
#include "synth/scene_builders.h"

namespace arris::synth {

namespace {

const Material kWall{0.7, 6, 0xd800, 0xd000, 0xc000};
const Material kRoof{0.3, 6, 0x9c00, 0x4800, 0x3400};
const Material kPane{0.15, 6, 0x5000, 0x6000, 0x7800};
const Material kReveal{0.6, 6, 0xc800, 0xc8c8, 0xc800};

constexpr double kWindowWidth = 1.1, kWindowHeight = 1.4, kSillHeight = 0.9;

/// A house in its own frame: x along the ridge, y across, z up from the ground, origin in the middle of the footprint.
class HouseBuilder {
 public:
  HouseBuilder(SceneModel& model, const House& house) : model_(model), house_(house) {
    turn_ = sin_cos_turns(house.heading_turns);
    const SinCos pitch = sin_cos_turns(house.pitch_deg / 360.0);
    slope_ = pitch.sin / pitch.cos;
    ridge_height_ = house.eave_height + half_width() * slope_;
    eaves_are_free_ = !house.walls || house.overhang > 0.0;
  }

  void build() {
    house_.hip ? hip_roof() : gable_roof();
    if (house_.walls) walls();
  }

 private:
  double half_length() const { return 0.5 * house_.length; }
  double half_width() const { return 0.5 * house_.width; }

  Vec3 at(double x, double y, double z) const {
    return house_.centre + Vec3{turn_.cos * x - turn_.sin * y, turn_.sin * x + turn_.cos * y, z};
  }

  void eave(const Vec3& a, const Vec3& b) {
    if (eaves_are_free_) {
      model_.segment(EdgeKind::kBoundary, "eave", a, b);
    } else {
      model_.segment(EdgeKind::kConvex, "eave", a, b, 90.0 + house_.pitch_deg);
    }
  }

  void gable_roof() {
    const double x = half_length() + house_.overhang, y = half_width() + house_.overhang;
    const double low = house_.eave_height - house_.overhang * slope_;
    const Vec3 ridge_a = at(-x, 0, ridge_height_), ridge_b = at(x, 0, ridge_height_);
    model_.segment(EdgeKind::kConvex, "ridge", ridge_a, ridge_b, 180.0 - 2.0 * house_.pitch_deg);
    for (const double side : {-1.0, 1.0}) {
      const Vec3 a = at(side * -x, -side * y, low), b = at(side * x, -side * y, low);
      const Vec3 top_a = side > 0 ? ridge_a : ridge_b, top_b = side > 0 ? ridge_b : ridge_a;
      model_.rectangle(a, b, top_a, kRoof);
      eave(a, b);
      for (const auto& [foot, top] : {std::pair{a, top_a}, std::pair{b, top_b}}) {
        model_.segment(eaves_are_free_ ? EdgeKind::kBoundary : EdgeKind::kConvex, "gable", foot, top,
                       eaves_are_free_ ? 0.0 : 90.0);
      }
    }
  }

  void hip_roof() {
    const double x = half_length() + house_.overhang, y = half_width() + house_.overhang;
    const double low = house_.eave_height - house_.overhang * slope_;
    const double ridge_half = half_length() - half_width();
    const Vec3 ridge_a = at(-ridge_half, 0, ridge_height_), ridge_b = at(ridge_half, 0, ridge_height_);
    const Vec3 c0 = at(-x, -y, low), c1 = at(x, -y, low), c2 = at(x, y, low), c3 = at(-x, y, low);
    model_.polygon({c0, c1, ridge_b, ridge_a}, kRoof);
    model_.polygon({c1, c2, ridge_b}, kRoof);
    model_.polygon({c2, c3, ridge_a, ridge_b}, kRoof);
    model_.polygon({c3, c0, ridge_a}, kRoof);
    if (ridge_half > 0.0) model_.segment(EdgeKind::kConvex, "ridge", ridge_a, ridge_b, 180.0 - 2.0 * house_.pitch_deg);
    const auto hip = [&](const Vec3& corner, const Vec3& top, const Vec3& neighbour_1, const Vec3& neighbour_2) {
      model_.segment(EdgeKind::kConvex, "hip", corner, top,
                     dihedral_deg(corner, top, neighbour_1 - corner, neighbour_2 - corner));
    };
    hip(c0, ridge_a, c1, c3);
    hip(c1, ridge_b, c0, c2);
    hip(c2, ridge_b, c1, c3);
    hip(c3, ridge_a, c2, c0);
    eave(c0, c1);
    eave(c1, c2);
    eave(c2, c3);
    eave(c3, c0);
  }

  void walls() {
    const double x = half_length(), y = half_width(), h = house_.eave_height;
    for (const double side : {-1.0, 1.0}) {
      long_wall(side);
      if (house_.hip) {
        model_.rectangle(at(side * x, -side * y, 0), at(side * x, side * y, 0), at(side * x, -side * y, h), kWall);
        soffit(at(side * x, -y, h), at(side * x, y, h), 90.0 - house_.pitch_deg);
      } else {
        const Vec3 top = at(side * x, 0, ridge_height_), a = at(side * x, -side * y, h), b = at(side * x, side * y, h);
        model_.polygon({at(side * x, -side * y, 0), at(side * x, side * y, 0), b, top, a}, kWall);
        soffit(a, top, 90.0);
        soffit(top, b, 90.0);
      }
      for (const double other : {-1.0, 1.0}) {
        model_.segment(EdgeKind::kConvex, "wall_corner", at(side * x, other * y, 0), at(side * x, other * y, h), 90.0);
      }
      footing(at(-x, side * y, 0), at(x, side * y, 0));
      footing(at(side * x, -y, 0), at(side * x, y, 0));
    }
  }

  void soffit(const Vec3& a, const Vec3& b, double angle_deg) {
    if (house_.overhang > 0.0) model_.segment(EdgeKind::kConcave, "soffit", a, b, angle_deg);
  }

  void footing(const Vec3& a, const Vec3& b) {
    model_.segment(house_.on_ground ? EdgeKind::kConcave : EdgeKind::kBoundary, "footing", a, b,
                   house_.on_ground ? 90.0 : 0.0);
  }

  /// The wall at y = side * width / 2, with its windows.
  void long_wall(double side) {
    const double x = half_length(), y = side * half_width(), h = house_.eave_height;
    const std::size_t wall = model_.faces.size();
    model_.rectangle(at(-x, y, 0), at(x, y, 0), at(-x, y, h), kWall);
    soffit(at(-x, y, h), at(x, y, h), 90.0 - house_.pitch_deg);
    for (int i = 0; i < house_.windows; ++i) {
      const double middle = house_.length * (i + 0.5) / house_.windows;
      for (double sill = kSillHeight; sill + kWindowHeight + 0.3 < h; sill += 2.8) {
        const Rect2 hole{{middle - 0.5 * kWindowWidth, sill}, {middle + 0.5 * kWindowWidth, sill + kWindowHeight}};
        model_.faces[wall].rect_holes.push_back(hole);
        window(hole, y, y - side * house_.window_recess);
      }
    }
  }

  /// @param outer, inner  y of the wall and of the pane.
  void window(const Rect2& hole, double outer, double inner) {
    const double x0 = hole.min.u - half_length(), x1 = hole.max.u - half_length(), z0 = hole.min.v, z1 = hole.max.v;
    const auto ring = [&](double y) {
      return std::vector<Vec3>{at(x0, y, z0), at(x1, y, z0), at(x1, y, z1), at(x0, y, z1)};
    };
    const std::vector<Vec3> front = ring(outer), back = ring(inner);
    model_.rectangle(back[0], back[1], back[3], kPane);
    model_.loop(EdgeKind::kConvex, "window", front, 90.0);
    model_.loop(EdgeKind::kConcave, "pane", back, 90.0);
    for (std::size_t i = 0; i < 4; ++i) {
      model_.rectangle(front[i], front[(i + 1) % 4], back[i], kReveal);
      model_.segment(EdgeKind::kConcave, "reveal", front[i], back[i], 90.0);
    }
  }

  SceneModel& model_;
  const House& house_;
  SinCos turn_;
  double slope_ = 0.0;
  double ridge_height_ = 0.0;
  bool eaves_are_free_ = false;
};

/// Around the house, as far as its walls or its roof without them.
void add_ground(SceneModel& model, const House& house) {
  constexpr double kGroundAround = 5.0;
  const Material ground{0.4, 2, 0x7000, 0x7c00, 0x5000};
  const double x = 0.5 * house.length, y = 0.5 * house.width;
  const double far_x = x + kGroundAround, far_y = y + kGroundAround;
  model.rectangle({-far_x, -far_y, 0}, {far_x, -far_y, 0}, {-far_x, far_y, 0}, ground).rect_holes = {
      {{kGroundAround, kGroundAround}, {kGroundAround + house.length, kGroundAround + house.width}}};
  model.loop(EdgeKind::kBoundary, "ground_border",
             {{-far_x, -far_y, 0}, {far_x, -far_y, 0}, {far_x, far_y, 0}, {-far_x, far_y, 0}});
  if (!house.walls) model.loop(EdgeKind::kBoundary, "shadow", {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}});
}

SceneModel build_single_house(const OptionValues& options, bool hip) {
  House house;
  house.length = options.at("length");
  house.width = options.at("width");
  house.eave_height = options.at("eave");
  house.pitch_deg = options.at("pitch");
  house.overhang = options.at("overhang");
  house.hip = hip;
  house.walls = options.at("walls") != 0.0;
  house.on_ground = options.at("ground") != 0.0;
  if (hip && house.length < house.width) {
    throw ConfigError("a hip roof must be at least as long as it is wide; swap the options length and width");
  }
  const SinCos pitch = sin_cos_turns(house.pitch_deg / 360.0);
  if (house.eave_height <= house.overhang * pitch.sin / pitch.cos) {
    throw ConfigError(
        "the overhanging eaves would reach the ground; lower the option overhang or pitch, or raise eave");
  }
  SceneModel model;
  add_house(model, house);
  if (house.on_ground) add_ground(model, house);
  add_airborne(model, options);
  return model;
}

}  // namespace

void add_house(SceneModel& model, const House& house) {
  HouseBuilder(model, house).build();
}

SceneModel build_gable(const OptionValues& options, double /*spacing*/) {
  return build_single_house(options, false);
}
SceneModel build_hip(const OptionValues& options, double /*spacing*/) {
  return build_single_house(options, true);
}

}  // namespace arris::synth
