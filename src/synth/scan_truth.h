#pragma once
/// @file The contours that a scan from several stations shows: seen parts of the model's edges, and borders of what is
/// seen. Private to synth.
///
/// Occlusion: a line on a face that goes on where the view of a station ends (shadows, horizons of columns, limits of
/// the field of view and of the range) is a boundary of role "occlusion" if without that station the mean spacing is
/// more than 5 times larger, or nothing is seen at all. Where it runs within 1.5 mm along an edge of the model, that
/// edge stands for it. Registration errors of the stations are not in the truth.

#include <vector>

#include "synth/scan_grid.h"
#include "synth/scene_model.h"

namespace arris::synth {

/// Model edges first, then occlusion by face; pieces of at most 0.5 m that carry their spacings: of folds on the side
/// where they are larger, of boundaries on the seen side (of occlusion: where the station still sees). Occlusion lines
/// are exact to 0.5 mm. Takes seconds for a town; the result does not depend on the number of threads.
std::vector<TruthEdge> scan_truth(const SceneModel& model, const ScanGrid& grid);

}  // namespace arris::synth
