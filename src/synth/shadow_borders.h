#pragma once
/// @file Where on one face the view of a station ends although the face goes on. Private to synth.
///
/// The face is sampled on a raster of 1/100 of the root of its area, at least 0.02 and at most 0.1 m. Cells whose
/// corners differ are sampled on a raster four times finer, and so are neighbours into which a border leads; the
/// places where the fine raster's lines cross the border are found by bisection to 0.1 mm and joined by
/// straight segments. Within one fine cell of where borders meet each other or an edge of the face, corners are cut. A
/// shadow or a gap of light that is narrower than the coarse raster and meets no other one may be
/// missed.

#include <vector>

#include "synth/polylines.h"
#include "synth/scan_visibility.h"

namespace arris::synth {

/// Pieces of the borders of the regions of `face` that a station sees, by station. Parts of these borders may run
/// along the face's own edges where other faces meet it. Runs in parallel; the result does not depend on the number of
/// threads. Memory: about 10 bytes per raster node, 500 per cell on a border.
std::vector<std::vector<KeyedSegment>> shadow_borders(const SceneModel& model, std::uint32_t face,
                                                      const ScanVisibility& visibility);

}  // namespace arris::synth
