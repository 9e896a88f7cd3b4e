#pragma once
/// @file EdgeScore of the contours of supervoxels.

#include "features/zheng/zheng_settings.h"

namespace arris {

/// (1 - d / cap) min(1, angle / 2T): close pairs of supervoxels at a clear angle. [0, 1].
/// @param distance   of the mutual nearest neighbours, steps, at most the cap.
/// @param angle_deg  between the normals, above T.
float contact_score(double distance, double angle_deg, const ZhengSettings& settings);

/// The free range of directions over the one that a straight border shows where it is sampled at the spacing, at
/// most 1.
float border_score(double free_deg, const ZhengLengths& lengths);

}  // namespace arris
