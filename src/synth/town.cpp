#include <array>

#include "synth/deterministic_math.h"
#include "synth/house.h"
#include "synth/scene_builders.h"

namespace arris::synth {

namespace {

const Material kGround{0.35, 2, 0x6c00, 0x6c00, 0x6800};
const Material kConcrete{0.55, 1, 0xa400, 0xa400, 0x9c00};
const Material kMarble{0.8, 1, 0xe800, 0xe400, 0xd800};
const Material kSteel{0.25, 1, 0x2800, 0x4400, 0x7000};

constexpr double kGroundHalf = 40.0;
constexpr double kScannerHeight = 1.7;

void add_houses(SceneModel& model, bool windows) {
  struct Plot {
    double x, y, heading_deg, length, width, eave, pitch_deg;
    bool hip;
  };
  constexpr std::array<Plot, 8> kPlots{{{-27, 13, 2, 13, 9, 5.5, 38, false},
                                        {-10, 14, -3, 11, 8, 3.2, 42, true},
                                        {8, 13, 1, 14, 9, 6.2, 30, false},
                                        {27, 15, -6, 12, 10, 5.6, 25, true},
                                        {-25, -14, 4, 12, 8, 3.4, 45, false},
                                        {-8, -13, -2, 13, 9, 5.8, 35, false},
                                        {10, -15, 3, 12, 9, 6.0, 28, true},
                                        {29, -13, -1, 10, 8, 3.0, 40, false}}};
  for (const Plot& plot : kPlots) {
    House house;
    house.centre = {plot.x, plot.y, 0};
    house.heading_turns = plot.heading_deg / 360.0;
    house.length = plot.length;
    house.width = plot.width;
    house.eave_height = plot.eave;
    house.pitch_deg = plot.pitch_deg;
    house.overhang = 0.4;
    house.hip = plot.hip;
    house.windows = windows ? 4 : 0;
    add_house(model, house);
  }
}

void add_column(SceneModel& model, double x, double y, double radius, double height) {
  const Vec3 up{0, 0, 1};
  model.cylinder({x, y, 0}, up, height, radius, kMarble);
  model.disc({x, y, height}, up, radius, kMarble);
  model.circle(EdgeKind::kRimConvex, "column_top", {x, y, height}, up, radius, 90.0);
  model.circle(EdgeKind::kRimConcave, "column_foot", {x, y, 0}, up, radius, 90.0);
}

/// A box that stands on the ground: walls, plinths, containers.
void add_box(SceneModel& model, const Vec3& centre, const Vec3& size, double heading_deg, const Material& material) {
  const SinCos turn = sin_cos_turns(heading_deg / 360.0);
  const auto at = [&](double x, double y, double z) {
    return Vec3{centre.x + turn.cos * x - turn.sin * y, centre.y + turn.sin * x + turn.cos * y, z};
  };
  const double x = 0.5 * size.x, y = 0.5 * size.y, h = size.z;
  const std::array<std::array<double, 2>, 4> corners{{{-x, -y}, {x, -y}, {x, y}, {-x, y}}};
  std::vector<Vec3> foot, top;
  for (const auto& [cx, cy] : corners) {
    foot.push_back(at(cx, cy, 0));
    top.push_back(at(cx, cy, h));
  }
  for (std::size_t i = 0; i < 4; ++i) {
    model.rectangle(foot[i], foot[(i + 1) % 4], top[i], material);
    model.segment(EdgeKind::kConvex, "box", foot[i], top[i], 90.0);
  }
  model.rectangle(top[0], top[1], top[3], material);
  model.loop(EdgeKind::kConvex, "box", top, 90.0);
  model.loop(EdgeKind::kConcave, "footing", foot, 90.0);
}

}  // namespace

SceneModel build_town(const OptionValues& options, double /*spacing*/) {
  SceneModel model;
  constexpr double g = kGroundHalf;
  model.rectangle({-g, -g, 0}, {g, -g, 0}, {-g, g, 0}, kGround);
  model.loop(EdgeKind::kBoundary, "ground_border", {{-g, -g, 0}, {g, -g, 0}, {g, g, 0}, {-g, g, 0}});
  add_houses(model, options.at("windows") != 0.0);
  for (int i = 0; i < 6; ++i) add_column(model, -6.0 + 2.4 * i, 4.5, 0.15 + 0.05 * i, 3.5);
  add_box(model, {-16, 6.5, 0}, {9.0, 0.3, 1.8}, 2.0, kConcrete);
  add_box(model, {18, -6.8, 0}, {8.0, 0.3, 1.2}, -1.0, kConcrete);
  add_box(model, {20, 4.5, 0}, {6.06, 2.44, 2.59}, 12.0, kSteel);
  add_box(model, {-20, -4.5, 0}, {1.2, 1.2, 0.8}, 30.0, kMarble);
  add_box(model, {0, -6.0, 0}, {3.0, 0.6, 0.45}, 5.0, kConcrete);

  constexpr std::array<std::array<double, 2>, 8> kTripods{
      {{-14, 0.5}, {13, -1.0}, {-30, -2.0}, {30, 1.0}, {-1, 24}, {1, -25}, {-35, 30}, {35, -30}}};
  const std::size_t stations = static_cast<std::size_t>(options.at("stations"));
  for (std::size_t i = 0; i < stations; ++i) {
    model.stations.push_back({{kTripods[i][0], kTripods[i][1], kScannerHeight}});
  }
  return model;
}

}  // namespace arris::synth
