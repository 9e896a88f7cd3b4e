#include "features/zheng/supervoxel_frame.h"

namespace arris {

SupervoxelFrame supervoxel_frame(const SupervoxelTable& table, std::uint32_t label) {
  const Vector3 n{table.normal[label][0], table.normal[label][1], table.normal[label][2]};
  if (dot(n, n) < 0.5) return {};
  return {plane_frame(n), true};
}

}  // namespace arris
