#include "synth/scan_truth.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "evaluate/edge_index.h"
#include "synth/shadow_borders.h"
#include "synth/surface_frame.h"
#include "synth/visible_edges.h"

namespace arris::synth {

namespace {

constexpr double kSpacingJump = 5.0;     // Of the mean spacing, that makes a boundary.
constexpr double kOnModelEdge = 1.5e-3;  // Metres.
constexpr double kSimplify = 4e-4;       // Metres; with the bisection's 0.1 mm not above the stated 0.5 mm.
constexpr double kLongestPiece = 0.5, kShortestCut = 0.02;
constexpr double kSpacingChange = 1.2;

class OcclusionFinder {
 public:
  OcclusionFinder(const SceneModel& model, const ScanVisibility& visibility)
      : model_(model), visibility_(visibility), model_edges_(model.edges) {}

  void add_face(std::uint32_t face, std::vector<TruthEdge>& out) const {
    auto borders = shadow_borders(model_, face, visibility_);
    for (std::uint32_t station = 0; station < borders.size(); ++station) {
      for (const auto& line : join_segments(kept(face, station, borders[station]))) {
        const std::vector<Vec3> vertices = simplify(line, kSimplify);
        ScanVisibility::Scratch scratch;
        for (std::size_t i = 1; i < vertices.size(); ++i) {
          add(face, station, vertices[i - 1], vertices[i], scratch, out);
        }
      }
    }
  }

 private:
  std::vector<KeyedSegment> kept(std::uint32_t face, std::uint32_t station,
                                 const std::vector<KeyedSegment>& segments) const {
    std::vector<char> keep(segments.size(), 0);
    parallel_for_chunks(segments.size(), 256, [&](std::size_t begin, std::size_t end) {
      ScanVisibility::Scratch scratch;
      for (std::size_t i = begin; i < end; ++i) {
        keep[i] = !on_model_edge(segments[i]) && jumps(face, station, segments[i], scratch) ? 1 : 0;
      }
    });
    std::vector<KeyedSegment> result;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      if (keep[i] != 0) result.push_back(segments[i]);
    }
    return result;
  }

  bool on_model_edge(const KeyedSegment& segment) const {
    const auto near = [&](const Vec3& p) { return model_edges_.nearest(p, kOnModelEdge).distance <= kOnModelEdge; };
    return near(segment.a) && near(segment.b) && near(0.5 * (segment.a + segment.b));
  }

  StationMask others(std::uint32_t station, const SurfacePoint& point, ScanVisibility::Scratch& scratch) const {
    return visibility_.seen_by(point, visibility_.every_station() & ~(StationMask{1} << station), scratch);
  }

  bool jumps(std::uint32_t face, std::uint32_t station, const KeyedSegment& segment,
             ScanVisibility::Scratch& scratch) const {
    const SurfacePoint middle = surface_near(model_.faces[face], face, 0.5 * (segment.a + segment.b));
    const StationMask without = others(station, middle, scratch);
    if (without == 0) return true;
    const double with = visibility_.spacing(middle, without | StationMask{1} << station).mean;
    return visibility_.spacing(middle, without).mean > kSpacingJump * with;
  }

  LocalSpacing spacing_at(std::uint32_t face, std::uint32_t station, const Vec3& p,
                          ScanVisibility::Scratch& scratch) const {
    const SurfacePoint place = surface_near(model_.faces[face], face, p);
    return visibility_.spacing(place, others(station, place, scratch) | StationMask{1} << station);
  }

  void add(std::uint32_t face, std::uint32_t station, const Vec3& a, const Vec3& b, ScanVisibility::Scratch& scratch,
           std::vector<TruthEdge>& out) const {
    const double length = norm(b - a);
    if (!(length > 0.0)) return;
    const double at_a = spacing_at(face, station, a, scratch).mean, at_b = spacing_at(face, station, b, scratch).mean;
    if (length > kLongestPiece ||
        (length > kShortestCut && std::max(at_a, at_b) > kSpacingChange * std::min(at_a, at_b))) {
      const Vec3 middle = 0.5 * (a + b);
      add(face, station, a, middle, scratch, out);
      add(face, station, middle, b, scratch, out);
      return;
    }
    TruthEdge edge = evaluate::make_segment(EdgeKind::kBoundary, "occlusion", a, b);
    const LocalSpacing spacing = spacing_at(face, station, 0.5 * (a + b), scratch);
    edge.spacing = spacing.mean;
    edge.spacing_max = spacing.coarse;
    out.push_back(std::move(edge));
  }

  const SceneModel& model_;
  const ScanVisibility& visibility_;
  evaluate::EdgeIndex model_edges_;
};

}  // namespace

std::vector<TruthEdge> scan_truth(const SceneModel& model, const ScanGrid& grid) {
  const ScanVisibility visibility(model, grid);
  std::vector<TruthEdge> edges = visible_edges(model, visibility);
  const OcclusionFinder occlusion(model, visibility);
  std::vector<std::vector<TruthEdge>> of_face(model.faces.size());
  parallel_for_chunks(model.faces.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) occlusion.add_face(static_cast<std::uint32_t>(i), of_face[i]);
  });
  for (const auto& some : of_face) edges.insert(edges.end(), some.begin(), some.end());
  return edges;
}

}  // namespace arris::synth
