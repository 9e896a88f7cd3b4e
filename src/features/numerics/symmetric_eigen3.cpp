#include "features/numerics/symmetric_eigen3.h"

#include "features/numerics/frame_lanes.h"

namespace arris {
namespace {

Vector3 array_of(const VectorOf3<double>& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

Vector3 kernel_vector(const SymmetricMatrix<double>& a, double value) {
  return array_of(detail::kernel_vectors(a, value));
}

PrincipalFrame principal_frame(const SymmetricMatrix<double>& a, const Eigenvalues<double>& values) {
  const FrameLanes<double> frame = frame_lanes(a, values);
  return {values, array_of(frame.e1), array_of(frame.e2), array_of(frame.e3)};
}

}  // namespace arris
