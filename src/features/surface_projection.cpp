#include "features/surface_projection.h"

namespace arris {

void SurfaceProjection::begin(const SupervoxelFrame& frame) {
  frame_ = frame;
  for (auto* column : {&a_, &b_, &w_}) column->clear();
}

void SurfaceProjection::add(const LabelledGroup& group, const LabelledPart& part) {
  std::size_t to = a_.size();
  for (auto* column : {&a_, &b_, &w_}) column->resize(to + part.end - part.begin);
  for (std::size_t i = part.begin; i < part.end; ++i, ++to) {
    const double x = group.x()[i];
    const double y = group.y()[i];
    const double z = group.z()[i];
    a_[to] = frame_.u[0] * x + frame_.u[1] * y + frame_.u[2] * z;
    b_[to] = frame_.v[0] * x + frame_.v[1] * y + frame_.v[2] * z;
    w_[to] = frame_.n[0] * x + frame_.n[1] * y + frame_.n[2] * z;
  }
}

double SurfaceProjection::exposure_deg(const Vector3& at, double alpha) {
  const std::size_t size = a_.size();
  if (neighbours_.a.size() < size) {
    neighbours_.a.resize(size);
    neighbours_.b.resize(size);
  }
  const double a = dot(frame_.u, at);
  const double b = dot(frame_.v, at);
  const double w = dot(frame_.n, at);
  const double unit = 1.0 / (2.0 * alpha);
  const double most_d2 = 4.0 * alpha * alpha;
  std::size_t n = 0;
  for (std::size_t i = 0; i < size; ++i) {
    // Without branches: every point is written, and the end advances past neighbours only.
    const double da = a_[i] - a;
    const double db = b_[i] - b;
    const double dw = w_[i] - w;
    neighbours_.a[n] = da * unit;
    neighbours_.b[n] = db * unit;
    n += da * da + db * db + dw * dw < most_d2;
  }
  neighbours_.count = n;
  return exposed_(neighbours_);
}

}  // namespace arris
