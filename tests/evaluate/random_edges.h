#pragma once
/// @file RapidCheck generators of truth edges.

#include <rapidcheck.h>

#include <string>

#include "evaluate/truth_edge.h"

namespace arris::evaluate {

inline rc::Gen<double> coordinate() {
  return rc::gen::map(rc::gen::inRange(-10000, 10001), [](int i) { return i * 0.00137; });
}

inline rc::Gen<Vec3> position() {
  return rc::gen::apply(
      [](double x, double y, double z) {
        return Vec3{x, y, z};
      },
      coordinate(), coordinate(), coordinate());
}

/// Segments (some of length 0), circles and arcs.
inline rc::Gen<TruthEdge> any_edge() {
  return rc::gen::apply(
      [](int shape, const Vec3& a, const Vec3& b, int radius, int sweep, int kind) {
        const EdgeKind edge_kind = kAllEdgeKinds[static_cast<std::size_t>(kind)];
        if (shape == 0 || !(norm(b) > 0.0)) return make_segment(edge_kind, "segment", a, b, 90.0);
        TruthEdge edge = make_circle(edge_kind, "circle", a, b, radius * 0.01, 90.0);
        if (shape == 2) edge.sweep_deg = sweep * 0.1;
        return edge;
      },
      rc::gen::inRange(0, 3), position(), position(), rc::gen::inRange(1, 900), rc::gen::inRange(1, 3600),
      rc::gen::inRange(0, static_cast<int>(kEdgeKinds)));
}

}  // namespace arris::evaluate
