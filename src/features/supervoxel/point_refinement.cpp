#include "features/supervoxel/point_refinement.h"

#include <cmath>

namespace arris {
namespace {

constexpr float kSharedCosine = 0.98480775F;  // cos 10 degrees.
constexpr float kSharedOffset = 0.25F;        // Of a voxel.

bool has_normal(const ClusterPlane& plane) {
  return plane.normal[0] != 0.0F || plane.normal[1] != 0.0F || plane.normal[2] != 0.0F;
}
float fractions(std::int32_t voxel_steps) {
  return static_cast<float>(kVoxelFractions) * static_cast<float>(voxel_steps);
}

}  // namespace

bool planes_differ(const ClusterPlane& a, const ClusterPlane& b, std::int32_t voxel_steps) {
  if (!has_normal(a) || !has_normal(b)) return false;
  const float cosine = a.normal[0] * b.normal[0] + a.normal[1] * b.normal[1] + a.normal[2] * b.normal[2];
  if (std::abs(cosine) < kSharedCosine) return true;
  const float offset = kSharedOffset * fractions(voxel_steps);
  return plane_distance(a, b.position) > offset || plane_distance(b, a.position) > offset;
}

std::uint32_t refined_label(std::span<const ClusterPlane> planes, std::uint32_t own,
                            std::span<const std::uint32_t> others, const VoxelPosition& at, std::int32_t voxel_steps) {
  const float limit = plane_distance(planes[own], at) - kRefinementMargin * fractions(voxel_steps);
  std::uint32_t best = own;
  float least = limit;
  for (const std::uint32_t other : others) {
    if (!has_normal(planes[other])) continue;
    const float distance = plane_distance(planes[other], at);
    if (distance < least || (distance == least && best != own && other < best)) {
      least = distance;
      best = other;
    }
  }
  return best;
}

}  // namespace arris
