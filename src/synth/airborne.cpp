#include "synth/airborne.h"

#include <cmath>
#include <optional>

#include "synth/placement.h"

namespace arris::synth {

namespace {

constexpr double kReturns = 3.0;         // Of a beam through the middle of the crown.
constexpr double kCutPlace = 0.15;       // From the middle, in lengths of the roof: not at a corner of any roof.
constexpr double kLeastPart = 1e-6;      // m²; what is smaller is rounding.
constexpr double kSecondMaterial = 0.5;  // Of the first one's reflectance.
constexpr double kLevel = 1e-9;

Box3 bounds_of_buildings(const SceneModel& model) {
  Box3 box;
  for (const Face& face : model.faces) {
    if (face.material.classification != kGroundClass) box.include(face.bounds());
  }
  return box;
}

/// The part of a polygon where side(p) >= 0 (Sutherland and Hodgman 1974). Parts of a polygon that is not convex stay
/// joined by lines without width along the cut, which neither the area nor the even-odd rule notices.
template <class Side>
std::vector<Point2> clipped(const std::vector<Point2>& polygon, const Side& side) {
  std::vector<Point2> result;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const double before = side(polygon[j]), here = side(polygon[i]);
    if ((before < 0.0) != (here < 0.0)) {
      const double t = before / (before - here);
      result.push_back(
          {polygon[j].u + t * (polygon[i].u - polygon[j].u), polygon[j].v + t * (polygon[i].v - polygon[j].v)});
    }
    if (here >= 0.0) result.push_back(polygon[i]);
  }
  return result;
}

/// The part of a plane on one side of x = cut; empty if there is hardly anything.
std::optional<Face> part_beyond(const Face& face, double cut, double direction) {
  const std::vector<Point2> whole =
      face.outline.empty() ? std::vector<Point2>{{0, 0}, {face.size_u, 0}, {face.size_u, face.size_v}, {0, face.size_v}}
                           : face.outline;
  Face part = face;
  part.outline = clipped(whole, [&](const Point2& p) { return direction * (face.at(p.u, p.v).x - cut); });
  if (part.outline.size() < 3 || part.measure() < kLeastPart) return std::nullopt;
  return part;
}

Face of_second_material(Face face) {
  face.material.reflectance *= kSecondMaterial;
  face.material_number = 2;
  return face;
}

void cut_materials(SceneModel& model) {
  const Box3 box = bounds_of_buildings(model);
  const double cut = 0.5 * (box.min.x + box.max.x) + kCutPlace * (box.max.x - box.min.x);
  std::vector<Face> faces;
  for (const Face& face : model.faces) {
    const bool building = face.material.classification != kGroundClass;
    const bool can_be_cut = building && face.shape == Face::Shape::kPlane && !face.disc && face.circle_holes.empty() &&
                            face.rect_holes.empty();
    const auto low = can_be_cut ? part_beyond(face, cut, -1.0) : std::nullopt;
    const auto high = can_be_cut ? part_beyond(face, cut, 1.0) : std::nullopt;
    if (low && high) {
      faces.push_back(*low);
      faces.push_back(of_second_material(*high));
      continue;
    }
    const Box3 own = face.bounds();
    const bool beyond = building && 0.5 * (own.min.x + own.max.x) > cut;
    faces.push_back(beyond ? of_second_material(face) : face);
  }
  model.faces = std::move(faces);
}

/// The middle of the longest level eave, the first one of equals.
const TruthEdge* tree_eave(const SceneModel& model) {
  const TruthEdge* longest = nullptr;
  for (const TruthEdge& edge : model.edges) {
    if (edge.shape != TruthEdge::Shape::kSegment || std::abs(edge.b.z - edge.a.z) > kLevel) continue;
    if (edge.role != "eave" && edge.role != "parapet") continue;
    if (longest == nullptr || edge.length() > longest->length() + kLevel) longest = &edge;
  }
  return longest;
}

void add_tree(SceneModel& model) {
  const TruthEdge* eave = tree_eave(model);
  if (eave == nullptr) return;
  const Box3 box = bounds_of_buildings(model);
  const Vec3 middle = eave->point_at(0.5), along = normalized(eave->b - eave->a);
  Vec3 outward = middle - 0.5 * (box.min + box.max);
  outward = outward - dot(outward, along) * along;
  outward.z = 0.0;
  const Vec3 centre = middle + (kCrownRadius - kCrownOverlap) * normalized(outward);
  const double reflectance = model.faces.front().material.reflectance;
  Face& crown = model.faces.emplace_back();
  crown.shape = Face::Shape::kVolume;
  crown.ellipsoid = true;
  crown.returns = kReturns;
  crown.origin = centre - Vec3{kCrownRadius, kCrownRadius, kCrownHalfHeight};
  crown.size_u = crown.size_v = 2.0 * kCrownRadius;
  crown.size_w = 2.0 * kCrownHalfHeight;
  crown.material = {reflectance, kTreeClass, 0x3000, 0x6800, 0x2800};
}

void name_buildings(SceneModel& model) {
  for (Face& face : model.faces) {
    if (face.material.classification == Material{}.classification) face.material.classification = kBuildingClass;
  }
}

}  // namespace

std::vector<SceneOption> airborne_options() {
  std::vector<SceneOption> options{
      {"tree", 0.0, 0.0, 1.0, "1: with the crown of a tree that touches the eave (class 5, FaceId 0)"},
      {"materials", 1.0, 1.0, 2.0, "2: a part of the roof reflects half as much, and is a surface of its own"},
      {"intensity_noise", 0.0, 0.0, 1.0, "standard deviation of the intensity, share of it"}};
  for (SceneOption& option : options) option.quiet = true;
  return options;
}

std::vector<SceneOption> with_airborne_options(std::vector<SceneOption> own) {
  for (SceneOption& option : airborne_options()) own.push_back(std::move(option));
  return own;
}

void add_airborne(SceneModel& model, const OptionValues& options) {
  if (options.at("materials") >= 2.0) cut_materials(model);
  if (options.at("tree") > 0.0) {
    name_buildings(model);
    add_tree(model);
  }
  model.intensity_noise = options.at("intensity_noise");
}

void add_moved(SceneModel& model, const SceneModel& part, const Vec3& shift) {
  const Placement placement(false, shift, 0);
  for (Face face : part.faces) {
    face.origin = face.origin + shift;
    model.faces.push_back(std::move(face));
  }
  for (const TruthEdge& edge : part.edges) model.edges.push_back(placement.apply(edge));
}

}  // namespace arris::synth
