#include "synth/visible_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "synth/surface_frame.h"

namespace arris::synth {

namespace {

constexpr double kContact = 1e-6;   // Metres between an edge and a face that meets it; above rounding.
constexpr double kNearStep = 1e-4;  // Metres beside the edge where the face must go on to make a side.
constexpr double kLeastStep = 2e-3, kMostStep = 0.05;
constexpr double kLookEvery = 0.025;  // Metres.
constexpr std::size_t kLeastLooks = 9;
constexpr double kPrecision = 1e-4;  // Metres, of the ends of parts.
constexpr double kEndInset = 1e-3;   // Metres from an edge's ends, where further faces meet it.
constexpr double kLongestPiece = 0.5, kShortestCut = 0.02;
constexpr double kSpacingChange = 1.2;
constexpr double kStraightOn = -0.9998;  // Cosine of two sides that continue each other: within a degree.
constexpr double kTouching = 1e-3;       // Sine of the angle between an edge and a face that it runs in.

enum class State : std::uint8_t { kNone, kOneSide, kFull };

struct Look {
  State state = State::kNone;
  LocalSpacing spacing;
};

/// Points of an edge without libm, so that the truth's bytes are the same everywhere.
Vec3 place_on(const TruthEdge& edge, double fraction) {
  if (edge.shape == TruthEdge::Shape::kSegment) return edge.a + fraction * (edge.b - edge.a);
  const SinCos turn = sin_cos_turns(fraction * edge.sweep_deg / 360.0);
  return edge.a + turn.cos * edge.start + turn.sin * cross(edge.b, edge.start);
}

Vec3 tangent_of(const TruthEdge& edge, const Vec3& place) {
  return normalized(edge.shape == TruthEdge::Shape::kSegment ? edge.b - edge.a : cross(edge.b, place - edge.a));
}

Box3 box_of(const TruthEdge& edge) {
  Box3 box;
  if (edge.shape == TruthEdge::Shape::kSegment) {
    box.include(edge.a);
    box.include(edge.b);
    return box;
  }
  box.include(edge.a);
  return box.expanded(norm(edge.start));
}

bool meet(const Box3& a, const Box3& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y && a.min.z <= b.max.z &&
         b.min.z <= a.max.z;
}

class EdgeViewer {
 public:
  EdgeViewer(const SceneModel& model, const ScanVisibility& visibility, const TruthEdge& edge)
      : model_(model), visibility_(visibility), edge_(edge), length_(edge.length()) {
    const Box3 box = box_of(edge).expanded(kContact);
    for (std::uint32_t i = 0; i < model.faces.size(); ++i) {
      const Face::Shape shape = model.faces[i].shape;
      const bool surface = shape == Face::Shape::kPlane || shape == Face::Shape::kCylinder;
      if (surface && meet(box, model.faces[i].bounds())) faces_.push_back(i);
    }
  }

  std::vector<TruthEdge> parts() {
    if (!(length_ > 0.0)) return {};
    const std::size_t steps = std::max<std::size_t>(kLeastLooks, static_cast<std::size_t>(length_ / kLookEvery) + 1);
    double begin = 0.0, before = 0.0;
    State state = look(0.0).state;
    for (std::size_t i = 1; i <= steps; ++i) {
      const double here = static_cast<double>(i) / static_cast<double>(steps);
      const State next = look(here).state;
      if (next != state) {
        const double change = find_change(before, here, state);
        add(state, begin, change);
        begin = change;
        state = next;
      }
      before = here;
    }
    add(state, begin, 1.0);
    return std::move(parts_);
  }

 private:
  double find_change(double low, double high, State first) {
    while ((high - low) * length_ > kPrecision) {
      const double middle = 0.5 * (low + high);
      (look(middle).state == first ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  void add(State state, double from, double to) {
    if (state == State::kNone || (to - from) * length_ <= kPrecision) return;
    const double from_spacing = look(from + 0.02 * (to - from)).spacing.mean;
    const double to_spacing = look(to - 0.02 * (to - from)).spacing.mean;
    const bool changes = std::max(from_spacing, to_spacing) > kSpacingChange * std::min(from_spacing, to_spacing);
    const double piece = (to - from) * length_;
    if (piece > kLongestPiece || (changes && piece > kShortestCut)) {
      const double middle = 0.5 * (from + to);
      add(state, from, middle);
      add(state, middle, to);
      return;
    }
    const LocalSpacing spacing = look(0.5 * (from + to)).spacing;
    if (!(spacing.mean > 0.0)) return;  // A change that the looks stepped over.
    TruthEdge part = part_of(edge_, from, to);
    part.spacing = spacing.mean;
    part.spacing_max = spacing.coarse;
    const bool fold = (evaluate::mask(edge_.kind) & evaluate::kFoldKinds) != 0;
    if (state == State::kOneSide && fold) {
      part.kind = edge_.shape == TruthEdge::Shape::kArc ? EdgeKind::kRimBoundary : EdgeKind::kBoundary;
      part.role += part.role.empty() ? "silhouette" : "_silhouette";
      part.angle_deg = 0.0;
    }
    parts_.push_back(std::move(part));
  }

  Look look(double fraction) {
    const double inset = std::min(kEndInset / length_, 0.01);
    if (!edge_.closed()) fraction = std::clamp(fraction, inset, 1.0 - inset);
    const Vec3 place = place_on(edge_, fraction);
    const Vec3 along = tangent_of(edge_, place);
    const double step = std::clamp(visibility_.facing_spacing(place), kLeastStep, kMostStep);
    sides_.clear();
    Look result;
    for (const std::uint32_t i : faces_) {
      const Face& face = model_.faces[i];
      const SurfacePoint on_face = surface_near(face, i, place);
      if (norm(on_face.position - place) > kContact || std::abs(dot(on_face.normal, along)) > kTouching) continue;
      const Vec3 across = normalized(cross(on_face.normal, along));
      for (const Vec3& side : {across, -across}) look_aside(face, i, place, side, step, result.spacing);
    }
    if (sides_.empty()) return result;
    bool continued = false;
    result.state = State::kOneSide;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double cosine = dot(sides_[i], sides_[j]);
        if (cosine <= kStraightOn) continued = true;
        // Two faces on the same side are one surface.
        if (cosine > kStraightOn && cosine < -kStraightOn) result.state = State::kFull;
      }
    }
    if (result.state == State::kOneSide && continued) return {};
    return result;
  }

  void look_aside(const Face& face, std::uint32_t index, const Vec3& place, const Vec3& side, double step,
                  LocalSpacing& spacing) {
    if (!owns(face, surface_near(face, index, place + kNearStep * side).position)) return;
    SurfacePoint beside = surface_near(face, index, place + step * side);
    for (; step > kNearStep && !owns(face, beside.position); step *= 0.5) {
      beside = surface_near(face, index, place + 0.5 * step * side);
    }
    const StationMask seen = visibility_.seen_by(beside, visibility_.every_station(), scratch_);
    if (seen == 0) return;
    sides_.push_back(side);
    const LocalSpacing here = visibility_.spacing(beside, seen);
    spacing.mean = std::max(spacing.mean, here.mean);
    spacing.coarse = std::max(spacing.coarse, here.coarse);
  }

  const SceneModel& model_;
  const ScanVisibility& visibility_;
  const TruthEdge& edge_;
  double length_;
  std::vector<std::uint32_t> faces_;  ///< That may meet the edge.
  std::vector<Vec3> sides_;           ///< Seen ones at the current place.
  std::vector<TruthEdge> parts_;
  ScanVisibility::Scratch scratch_;
};

}  // namespace

TruthEdge part_of(const TruthEdge& edge, double from, double to) {
  TruthEdge part = edge;
  if (edge.shape == TruthEdge::Shape::kSegment) {
    part.a = place_on(edge, from);
    part.b = to == 1.0 ? edge.b : place_on(edge, to);
  } else {
    part.start = place_on(edge, from) - edge.a;
    part.sweep_deg = edge.sweep_deg * (to - from);
  }
  return part;
}

std::vector<TruthEdge> visible_edges(const SceneModel& model, const ScanVisibility& visibility) {
  std::vector<std::vector<TruthEdge>> parts(model.edges.size());
  parallel_for_chunks(model.edges.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) parts[i] = EdgeViewer(model, visibility, model.edges[i]).parts();
  });
  std::vector<TruthEdge> result;
  for (std::vector<TruthEdge>& some : parts) {
    result.insert(result.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
  }
  return result;
}

}  // namespace arris::synth
