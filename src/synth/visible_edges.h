#pragma once
/// @file The parts of a model's edges that a scan shows, and as what. Private to synth.
///
/// At a place of an edge, faces lead away from it to one or several sides. A side is seen if some station sees the
/// surface one spacing beside the edge (facing spacing of the nearest station, 2 mm to 5 cm, less on narrow faces).
///
/// * Two sides seen that do not continue each other: the edge is what the model says.
/// * One side seen: a fold is a boundary there (rim_boundary if it is curved) of role "<role>_silhouette", angle 0;
///   a boundary stays as it is.
/// * No side seen, or only two that continue each other (a sheet over a wall whose top is hidden): no edge.
///
/// Edges are looked at every 2.5 cm at the most; where the answer changes is found to 0.1 mm. Parts shorter than 2.5 cm
/// may be missed.

#include <vector>

#include "synth/scan_visibility.h"

namespace arris::synth {

/// Every edge cut to the seen parts, which are cut to pieces of at most 0.5 m over which the mean spacing changes by at
/// most 20 % (pieces of less than 2 cm are not cut). Spacings are those at the middle of the piece, of the side where
/// they are larger. In the order of the edges and along each. Runs in parallel; the result does not depend on the
/// number of threads.
std::vector<TruthEdge> visible_edges(const SceneModel& model, const ScanVisibility& visibility);

/// The part of an edge between two fractions of its length, 0 <= from < to <= 1.
TruthEdge part_of(const TruthEdge& edge, double from, double to);

}  // namespace arris::synth
