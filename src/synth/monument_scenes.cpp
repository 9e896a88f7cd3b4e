#include <array>
#include <cmath>
#include <numbers>

#include "synth/airborne.h"
#include "synth/scene_builders.h"

namespace arris::synth {

namespace {

const Material kStone{0.5, 1, 0xb400, 0xac00, 0xa000};
const Material kBronze{0.35, 1, 0x6c00, 0x5400, 0x3000};
const Material kSteel{0.3, 1, 0x6000, 0x6800, 0x7400};
const Vec3 kUp{0, 0, 1};

std::vector<Vec3> ring(const Vec3& low, const Vec3& high, double z) {
  return {{low.x, low.y, z}, {high.x, low.y, z}, {high.x, high.y, z}, {low.x, high.y, z}};
}

/// The sides and the upper edges of an upright box.
void add_sides(SceneModel& model, const Vec3& low, const Vec3& high, const std::string& role) {
  const std::vector<Vec3> foot = ring(low, high, low.z), top = ring(low, high, high.z);
  for (std::size_t i = 0; i < 4; ++i) {
    model.rectangle(foot[i], foot[(i + 1) % 4], top[i], kStone);
    model.segment(EdgeKind::kConvex, role, foot[i], top[i], 90.0);
  }
  model.loop(EdgeKind::kConvex, role, top, 90.0);
}

Face& add_level(SceneModel& model, const Vec3& low, const Vec3& high, double z) {
  return model.rectangle({low.x, low.y, z}, {high.x, low.y, z}, {low.x, high.y, z}, kStone);
}

/// An S of two arcs of three quarters of a turn in the plane y = const, as a band of rectangular section.
class LetterS {
 public:
  LetterS(SceneModel& model, const Vec3& middle) : model_(model), middle_(middle) {}

  void build() {
    // Round -y a turn leads from x to z. The upper arc runs from the right over the top and the left to the middle;
    // the lower one from the left under the bottom and the right to the middle.
    for (const double side : {1.0, -1.0}) {
      arc(middle_ + Vec3{0, 0, side * kRadius}, {side, 0, 0});
      end(middle_ + Vec3{0, 0, side * kRadius}, side);
    }
  }

  static constexpr double kRadius = 0.4, kBand = 0.16, kDepth = 0.3;

 private:
  void arc(const Vec3& centre, const Vec3& start) {
    constexpr double kTurns = 0.75;
    const Vec3 axis{0, -1, 0};
    const Vec3 back = centre + Vec3{0, 0.5 * kDepth, 0}, front = centre - Vec3{0, 0.5 * kDepth, 0};
    for (const double radius : {kRadius + 0.5 * kBand, kRadius - 0.5 * kBand}) {
      model_.cylinder_part(back, kDepth * axis, radius * start, kTurns, kBronze);
      for (const Vec3& rim : {front, back}) {
        model_.arc(EdgeKind::kRimConvex, "letter", rim, axis, radius * start, 360.0 * kTurns, 90.0);
      }
    }
    for (const Vec3& side : {front, back}) {
      model_.ring_part(side, axis, (kRadius + 0.5 * kBand) * start, kRadius - 0.5 * kBand, kTurns).material = kBronze;
    }
  }

  /// The flat end of the band at the start of an arc.
  void end(const Vec3& centre, double side) {
    const Vec3 inner = centre + Vec3{side * (kRadius - 0.5 * kBand), 0, 0}, depth{0, 0.5 * kDepth, 0};
    const Vec3 outer = centre + Vec3{side * (kRadius + 0.5 * kBand), 0, 0};
    model_.rectangle(inner - depth, outer - depth, inner + depth, kBronze);
    model_.loop(EdgeKind::kConvex, "letter_end", {inner - depth, outer - depth, outer + depth, inner + depth}, 90.0);
  }

  SceneModel& model_;
  Vec3 middle_;
};

}  // namespace

SceneModel build_sculpture(const OptionValues& /*options*/, double /*spacing*/) {
  constexpr int kSteps = 3, kLetters = 3;
  constexpr double kRise = 0.16, kGoing = 0.35, kPitch = 1.3, kPost = 0.2, kPostHeight = 0.7, kGap = 0.05;
  SceneModel model;
  Vec3 low{-2.8, -1.4, 0}, high{2.8, 1.4, 0};
  model.loop(EdgeKind::kBoundary, "foot", ring(low, high, 0.0));
  for (int step = 0; step < kSteps; ++step) {
    low.z = step * kRise;
    high.z = low.z + kRise;
    add_sides(model, low, high, "step");
    Face& level = add_level(model, low, high, high.z);
    const Vec3 shrink{kGoing, kGoing, 0};
    const Vec3 next_low = low + shrink, next_high = high - shrink;
    if (step + 1 < kSteps) {
      level.rect_holes = {{{kGoing, kGoing}, {high.x - low.x - kGoing, high.y - low.y - kGoing}}};
      model.loop(EdgeKind::kConcave, "inner_corner", ring(next_low, next_high, high.z), 90.0);
      low = next_low;
      high = next_high;
      continue;
    }
    for (int i = 0; i < kLetters; ++i) {
      const double x = (i - 1) * kPitch;
      const Vec3 post_low{x - 0.5 * kPost, -0.5 * kPost, high.z},
          post_high{x + 0.5 * kPost, 0.5 * kPost, high.z + kPostHeight};
      level.rect_holes.push_back(
          {{post_low.x - low.x, post_low.y - low.y}, {post_high.x - low.x, post_high.y - low.y}});
    }
  }
  const double floor = kSteps * kRise;
  for (int i = 0; i < kLetters; ++i) {
    const double x = (i - 1) * kPitch;
    const Vec3 post_low{x - 0.5 * kPost, -0.5 * kPost, floor},
        post_high{x + 0.5 * kPost, 0.5 * kPost, floor + kPostHeight};
    add_sides(model, post_low, post_high, "post");
    add_level(model, post_low, post_high, post_high.z);
    model.loop(EdgeKind::kConcave, "post_foot", ring(post_low, post_high, floor), 90.0);
    // Held by pins thinner than the scan: 5 cm of air over the post.
    const double reach = 2.0 * LetterS::kRadius + 0.5 * LetterS::kBand;
    LetterS(model, {x, 0, post_high.z + kGap + reach}).build();
  }
  constexpr double kDisc = 0.13;
  const Vec3 disc{0, 0, floor + kPostHeight + kGap + 3.0 * LetterS::kRadius + 0.5 * LetterS::kBand};
  model.disc(disc, {0, 1, 0}, kDisc, kSteel);
  model.circle(EdgeKind::kRimBoundary, "disc", disc, {0, 1, 0}, kDisc);
  return model;
}

SceneModel build_columns(const OptionValues& options, double /*spacing*/) {
  const int count = static_cast<int>(std::floor(options.at("count")));
  const double height = options.at("height");
  constexpr double kPitch = 2.0, kHalfDepth = 0.8, kBase = 0.4, kBeam = 0.9, kFirst = 0.15, kLast = 0.5;
  SceneModel model;
  const double half = 0.5 * kPitch * count;
  const double beam = kBase + height;
  std::vector<Circle2> holes;
  for (int i = 0; i < count; ++i) {
    // From 0.3 to 1 m in diameter.
    const double radius = kFirst + (kLast - kFirst) * (count > 1 ? static_cast<double>(i) / (count - 1) : 1.0);
    const double x = -half + kPitch * (i + 0.5);
    holes.push_back({{kPitch * (i + 0.5), kHalfDepth}, radius});
    model.cylinder({x, 0, kBase}, kUp, height, radius, kStone);
    model.circle(EdgeKind::kRimConcave, "column_foot", {x, 0, kBase}, kUp, radius, 90.0);
    model.circle(EdgeKind::kRimConcave, "column_head", {x, 0, beam}, kUp, radius, 90.0);
  }
  const Vec3 low{-half, -kHalfDepth, 0}, high{half, kHalfDepth, kBase};
  add_sides(model, low, high, "base");
  add_level(model, low, high, kBase).circle_holes = holes;
  model.loop(EdgeKind::kBoundary, "foot", ring(low, high, 0.0));
  const Vec3 beam_low{-half, -kHalfDepth, beam}, beam_high{half, kHalfDepth, beam + kBeam};
  add_sides(model, beam_low, beam_high, "entablature");
  add_level(model, beam_low, beam_high, beam).circle_holes = holes;
  add_level(model, beam_low, beam_high, beam_high.z);
  model.loop(EdgeKind::kConvex, "entablature", ring(beam_low, beam_high, beam), 90.0);
  return model;
}

SceneModel build_dome(const OptionValues& options, double /*spacing*/) {
  const double radius = options.at("radius"), cut = options.at("cut") * radius;
  const double rim = std::sqrt(radius * radius - cut * cut), half = rim + 0.4 * radius;
  SceneModel model;
  const std::vector<Vec3> border = ring({-half, -half, 0}, {half, half, 0}, 0.0);
  model.rectangle(border[0], border[1], border[3], kStone).circle_holes = {{{half, half}, rim}};
  model.loop(EdgeKind::kBoundary, "eave", border);
  Face& cap = model.faces.emplace_back();
  cap.shape = Face::Shape::kSphere;
  cap.origin = {0, 0, -cut};
  cap.radius = radius;
  cap.cap_height = cut;
  cap.material = kSteel;
  // Between the roof, outwards, and the cap, along the tangent upwards: its cosine is -cut / radius.
  const double angle_deg = std::acos(-cut / radius) * 180.0 / std::numbers::pi;
  model.circle(EdgeKind::kRimConcave, "dome_foot", {0, 0, 0}, kUp, rim, angle_deg);
  add_airborne(model, options);
  return model;
}

}  // namespace arris::synth
