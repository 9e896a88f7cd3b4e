#include "features/liu/entropy_scale.h"

#include <algorithm>

namespace arris {
namespace {

/// First and second moments of a growing set, relative to the query.
struct RunningMoments {
  double x = 0, y = 0, z = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  void add(double dx, double dy, double dz) {
    x += dx;
    y += dy;
    z += dz;
    xx += dx * dx;
    xy += dx * dy;
    xz += dx * dz;
    yy += dy * dy;
    yz += dy * dz;
    zz += dz * dz;
  }
  /// n² times the covariance.
  SymmetricMatrix<double> scaled_covariance(double n) const {
    return {n * xx - x * x, n * xy - x * y, n * xz - x * z, n * yy - y * y, n * yz - y * z, n * zz - z * z};
  }
};

/// The running minimum over ascending k.
struct Best {
  double entropy = std::numeric_limits<double>::infinity();
  ScaleChoice choice;

  void offer(double e, const ScaleChoice& other) {
    if (!(e < entropy - kEntropyTie)) return;
    entropy = e;
    choice = other;
  }
};

}  // namespace

ScaleChoice choose_scale(const Neighbours& neighbours, const ScaleRange& range) {
  const int last = std::min(range.k_max, static_cast<int>(neighbours.count));
  Best planar;
  Best any;
  RunningMoments moments;
  std::size_t added = 0;
  for (int k = range.k_min; k <= last; k += range.k_step) {
    for (; added < static_cast<std::size_t>(k); ++added) {
      moments.add(neighbours.dx[added], neighbours.dy[added], neighbours.dz[added]);
    }
    ScaleChoice choice;
    choice.k = k;
    choice.covariance = moments.scaled_covariance(k + (range.with_target ? 1 : 0));
    choice.values = eigenvalues_of(choice.covariance);
    const double entropy = entropy_of(choice.values);
    any.offer(entropy, choice);
    if (choice.values.middle >= range.min_planarity * choice.values.largest) planar.offer(entropy, choice);
  }
  return planar.choice.k > 0 ? planar.choice : any.choice;
}

}  // namespace arris
