#include "features/neighbourhood/ball_points.h"

namespace arris {

template <class T>
void collect_ball(const CandidateSet<T>& c, const BallQuery<T>& ball, double spacing, BallPoints& points) {
  const std::size_t room = simd::padded(c.count) + simd::kPadding;
  if (points.x.size() < room) {
    for (auto* column : {&points.x, &points.y, &points.z}) column->resize(room);
  }
  const double inverse = 1.0 / spacing;
  std::size_t n = 0;
  for (std::size_t i = 0; i < c.count; ++i) {
    const T dx = bounded<T>(c.x[i] - ball.x);
    const T dy = bounded<T>(c.y[i] - ball.y);
    const T dz = bounded<T>(c.z[i] - ball.z);
    // Without branches: every point is written, and the end advances past members only.
    points.x[n] = on_grid<kCoordinateBits>(static_cast<double>(dx) * inverse);
    points.y[n] = on_grid<kCoordinateBits>(static_cast<double>(dy) * inverse);
    points.z[n] = on_grid<kCoordinateBits>(static_cast<double>(dz) * inverse);
    n += dx * dx + dy * dy + dz * dz <= ball.radius2;
  }
  points.count = n;
  for (std::size_t i = n; i < simd::padded(n); ++i) {
    points.x[i] = points.y[i] = points.z[i] = BallPoints::kPaddingCoordinate;
  }
}

template void collect_ball(const CandidateSet<float>&, const BallQuery<float>&, double, BallPoints&);
template void collect_ball(const CandidateSet<double>&, const BallQuery<double>&, double, BallPoints&);
template void collect_ball(const CandidateSet<std::int64_t>&, const BallQuery<std::int64_t>&, double, BallPoints&);

}  // namespace arris
