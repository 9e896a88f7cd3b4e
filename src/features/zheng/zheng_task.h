#pragma once
/// @file What the runners of Zheng et al.'s method share.

#include <cstdint>
#include <span>

#include "features/contour/found_records.h"
#include "features/contour/tile_contours.h"
#include "features/neighbourhood/point_tree.h"
#include "features/zheng/zheng_settings.h"

namespace arris {

/// One tile. Read only.
struct ZhengTask {
  const PointTree& tree;
  std::span<const std::uint32_t> labels;  ///< In the tree's order.
  const SupervoxelTable& table;
  const ZhengSettings& settings;
};

}  // namespace arris
