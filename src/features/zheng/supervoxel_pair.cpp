#include "features/zheng/supervoxel_pair.h"

#include <cmath>

#include "features/numerics/exact_math.h"

namespace arris {
namespace {

/// Squared sine of an angle below which planes are parallel: normals are floats.
constexpr double kParallelSine2 = 1e-10;

Vector3 normal_of(const SupervoxelTable& table, std::uint32_t label) {
  return {table.normal[label][0], table.normal[label][1], table.normal[label][2]};
}

}  // namespace

double normal_angle_deg(const SupervoxelTable& table, std::uint32_t a, std::uint32_t b) {
  const Vector3 na = normal_of(table, a);
  const Vector3 nb = normal_of(table, b);
  if (dot(na, na) < 0.5 || dot(nb, nb) < 0.5) return 0.0;
  const Vector3 across = cross(na, nb);
  return angle_of(std::sqrt(dot(across, across)), std::fabs(dot(na, nb))) * kDegreesPerRadian;
}

double step_height(const SupervoxelTable& table, std::uint32_t a, std::uint32_t b) {
  const Vector3 na = normal_of(table, a);
  const Vector3 nb = normal_of(table, b);
  if (dot(na, na) < 0.5 || dot(nb, nb) < 0.5) return 0.0;
  const double sign = dot(na, nb) < 0.0 ? -1.0 : 1.0;
  Vector3 mean, apart;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    mean[axis] = na[axis] + sign * nb[axis];
    apart[axis] = table.centroid[b][axis] - table.centroid[a][axis];
  }
  return std::fabs(dot(mean, apart)) / std::sqrt(dot(mean, mean));
}

double interior_angle_deg(const SupervoxelTable& table, std::uint32_t a, std::uint32_t b, const Vector3& contact) {
  const Vector3 along = cross(normal_of(table, a), normal_of(table, b));
  if (dot(along, along) < kParallelSine2) return 180.0;
  Vector3 away[2];
  const std::uint32_t labels[2] = {a, b};
  for (int k = 0; k < 2; ++k) {
    away[k] = cross(normal_of(table, labels[k]), along);
    Vector3 to_centroid;
    for (std::size_t axis = 0; axis < 3; ++axis) to_centroid[axis] = table.centroid[labels[k]][axis] - contact[axis];
    if (dot(away[k], to_centroid) < 0.0) {
      for (double& c : away[k]) c = -c;
    }
  }
  const Vector3 across = cross(away[0], away[1]);
  return angle_of(std::sqrt(dot(across, across)), dot(away[0], away[1])) * kDegreesPerRadian;
}

}  // namespace arris
