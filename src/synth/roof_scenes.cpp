#include <array>
#include <cmath>

#include "core/error.h"
#include "synth/airborne.h"
#include "synth/deterministic_math.h"
#include "synth/mesh.h"
#include "synth/scene_builders.h"

namespace arris::synth {

namespace {

const Material kTiles{0.3, 6, 0x9c00, 0x4800, 0x3400};
const Material kSlate{0.25, 6, 0x5000, 0x5400, 0x6000};

double slope_of(double degrees) {
  const SinCos angle = sin_cos_turns(degrees / 360.0);
  return angle.sin / angle.cos;
}

}  // namespace

SceneModel build_crossgable(const OptionValues& options, double /*spacing*/) {
  const double a = 0.5 * options.at("width"), x = 0.5 * options.at("length"), y = 0.5 * options.at("cross_length");
  if (x <= a || y <= a) throw ConfigError("both roofs must be longer than wide; raise length and cross_length");
  const double h = a * slope_of(options.at("pitch"));
  Mesh mesh;
  mesh.corners = {{0, 0, h}, {x, 0, h}, {-x, 0, h}, {0, y, h}, {0, -y, h}};
  for (const double sx : {1.0, -1.0}) {
    for (const double sy : {1.0, -1.0}) {
      const std::size_t n = mesh.corners.size();
      mesh.corners.insert(mesh.corners.end(), {{sx * a, sy * a, 0}, {sx * x, sy * a, 0}, {sx * a, sy * y, 0}});
      const std::size_t end_x = sx > 0.0 ? 1 : 2, end_y = sy > 0.0 ? 3 : 4;
      mesh.polygons.push_back({0, n, n + 1, end_x});
      mesh.polygons.push_back({0, n, n + 2, end_y});
    }
  }
  SceneModel model;
  add_mesh(model, mesh, kTiles);
  add_airborne(model, options);
  return model;
}

SceneModel build_mansard(const OptionValues& options, double /*spacing*/) {
  const double x = 0.5 * options.at("length"), y = 0.5 * options.at("width"), break_height = options.at("break");
  const double inset = break_height / slope_of(options.at("steep"));
  if (inset >= y || x < y) {
    throw ConfigError(
        "the steep slopes must end before they meet, and length be at least width; lower the option break");
  }
  const double h = break_height + (y - inset) * slope_of(options.at("pitch"));
  Mesh mesh;
  for (const auto& [grow, z] : {std::pair{0.0, 0.0}, std::pair{inset, break_height}}) {
    const double bx = x - grow, by = y - grow;
    mesh.corners.insert(mesh.corners.end(), {{-bx, -by, z}, {bx, -by, z}, {bx, by, z}, {-bx, by, z}});
  }
  mesh.corners.insert(mesh.corners.end(), {{-(x - y), 0, h}, {x - y, 0, h}});
  for (std::size_t i = 0; i < 4; ++i) mesh.polygons.push_back({i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i});
  if (x > y) {
    mesh.polygons.insert(mesh.polygons.end(), {{4, 5, 9, 8}, {5, 6, 9}, {6, 7, 8, 9}, {7, 4, 8}});
  } else {
    mesh.polygons.insert(mesh.polygons.end(), {{4, 5, 8}, {5, 6, 8}, {6, 7, 8}, {7, 4, 8}});
  }
  SceneModel model;
  add_mesh(model, mesh, kSlate);
  add_airborne(model, options);
  return model;
}

SceneModel build_dormer(const OptionValues& options, double /*spacing*/) {
  const double x = 0.5 * options.at("length"), d = 0.5 * options.at("width"), t = slope_of(options.at("pitch"));
  const double w = 0.5 * options.at("dormer_width"), wall = options.at("dormer_wall"), front = 0.75 * d;
  const double foot = (d - front) * t, eave = foot + wall, ridge = eave + w * t;
  if (ridge >= d * t || w >= x)
    throw ConfigError("the dormer does not fit into the roof; lower dormer_width or dormer_wall");
  const auto on_slope = [&](double z) { return z / t - d; };  // y of the main slope at a height.
  enum : std::size_t {
    kEaveL,
    kEaveM,
    kEaveR,
    kRidgeL,
    kRidgeM,
    kRidgeR,
    kBackL,
    kBackR,
    kFootL,
    kFootM,
    kFootR,
    kMeetL,
    kMeetR,
    kTop,
    kWallL,
    kWallR,
    kPeak
  };
  Mesh mesh;
  mesh.corners = {{-x, -d, 0},
                  {0, -d, 0},
                  {x, -d, 0},
                  {-x, 0, d * t},
                  {0, 0, d * t},
                  {x, 0, d * t},
                  {-x, d, 0},
                  {x, d, 0},
                  {-w, -front, foot},
                  {0, -front, foot},
                  {w, -front, foot},
                  {-w, on_slope(eave), eave},
                  {w, on_slope(eave), eave},
                  {0, on_slope(ridge), ridge},
                  {-w, -front, eave},
                  {w, -front, eave},
                  {0, -front, ridge}};
  mesh.inside = {0, 0.5 * (on_slope(eave) - front), foot};
  mesh.polygons = {// The slope with the dormer is cut in two along its middle; the halves lie in one plane.
                   {kEaveL, kEaveM, kFootM, kFootL, kMeetL, kTop, kRidgeM, kRidgeL},
                   {kEaveR, kEaveM, kFootM, kFootR, kMeetR, kTop, kRidgeM, kRidgeR},
                   {kRidgeL, kRidgeM, kRidgeR, kBackR, kBackL},
                   {kFootL, kFootM, kFootR, kWallR, kPeak, kWallL},
                   {kFootL, kMeetL, kWallL},
                   {kFootR, kMeetR, kWallR},
                   {kWallL, kPeak, kTop, kMeetL},
                   {kWallR, kPeak, kTop, kMeetR}};
  SceneModel model;
  add_mesh(model, mesh, kTiles);
  add_airborne(model, options);
  return model;
}

}  // namespace arris::synth
