#include "ball_testing.h"

#include <cmath>

#include "features/numerics/exact_math.h"

namespace arris::test {
namespace {

constexpr int kReach = 16;

/// Calls at(u, v) for one jittered place per unit square of [low_u, high_u) x [-kReach, kReach).
template <class At>
void sample(int low_u, int high_u, Random& random, At&& at) {
  for (int i = low_u; i < high_u; ++i) {
    for (int j = -kReach; j < kReach; ++j) {
      const double u = i + random.in(0.25, 0.75);
      const double v = j + random.in(0.25, 0.75);
      at(u, v);
    }
  }
}

}  // namespace

double Random::normal() {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += unit();
  return sum;
}

BallPoints ball_of(const std::vector<Vector3>& points, double radius) {
  constexpr double kSteps = 1 << kCoordinateBits;  // Per spacing: the grid of the ball.
  std::vector<LatticePoint> positions;
  std::vector<std::uint64_t> ids;
  for (const Vector3& p : points) {
    positions.push_back({static_cast<std::int32_t>(std::lround(p[0] * kSteps)),
                         static_cast<std::int32_t>(std::lround(p[1] * kSteps)),
                         static_cast<std::int32_t>(std::lround(p[2] * kSteps))});
    ids.push_back(ids.size());
  }
  const PointTree tree(positions, ids);
  CandidateSet<double> candidates;
  BallPoints ball;
  const ClosedBox origin{{0, 0, 0}, {0, 0, 0}};
  candidates.gather(tree, origin, radius * kSteps);
  BallQuery<double> query;
  query.x = static_cast<double>(-candidates.origin[0]);
  query.y = static_cast<double>(-candidates.origin[1]);
  query.z = static_cast<double>(-candidates.origin[2]);
  query.radius2 = std::floor(radius * kSteps * radius * kSteps);
  collect_ball(candidates, query, kSteps, ball);
  return ball;
}

Rotation any_rotation(std::uint64_t seed) {
  Random random(seed);
  Vector3 a{random.normal(), random.normal(), random.normal()};
  Vector3 b{random.normal(), random.normal(), random.normal()};
  const double la = std::sqrt(dot(a, a));
  for (double& c : a) c /= la;
  const double along = dot(a, b);
  for (int axis = 0; axis < 3; ++axis) b[axis] -= along * a[axis];
  const double lb = std::sqrt(dot(b, b));
  for (double& c : b) c /= lb;
  return {a, b, cross(a, b)};
}

Vector3 rotated(const Rotation& r, const Vector3& p) {
  return {dot(r[0], p), dot(r[1], p), dot(r[2], p)};
}

void rotate(const Rotation& rotation, std::vector<Vector3>& points) {
  for (Vector3& p : points) p = rotated(rotation, p);
}

void disturb(std::vector<Vector3>& points, double noise, std::uint64_t seed) {
  Random random(seed ^ 0x9e3779b97f4a7c15ULL);
  for (Vector3& p : points) {
    for (double& c : p) c += noise * random.normal();
  }
}

std::vector<Vector3> plane_points(std::uint64_t seed) {
  Random random(seed);
  std::vector<Vector3> points;
  sample(-kReach, kReach, random, [&](double u, double v) { points.push_back({u, v, 0.0}); });
  return points;
}

std::vector<Vector3> fold_points(double angle_deg, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vector3> points;
  const double half = 0.5 * angle_deg / kDegreesPerRadian;
  for (const double side : {-1.0, 1.0}) {
    sample(0, kReach, random, [&](double away, double along) {
      points.push_back({along, side * away * std::sin(half), away * std::cos(half)});
    });
  }
  return points;
}

std::vector<Vector3> layer_points(double gap, std::uint64_t seed) {
  std::vector<Vector3> points = plane_points(seed);
  for (const Vector3& p : plane_points(seed + 1)) points.push_back({p[0], p[1], p[2] + gap});
  return points;
}

std::vector<Vector3> rim_points(double radius, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vector3> points;
  sample(-kReach, kReach, random, [&](double x, double y) {
    if (std::hypot(x, y + radius) <= radius) points.push_back({x, y, 0.0});
  });
  sample(-kReach, 0, random, [&](double z, double along) {
    if (std::fabs(along) > kPi * radius) return;
    points.push_back({radius * std::sin(along / radius), radius * std::cos(along / radius) - radius, z});
  });
  return points;
}

std::vector<Vector3> column_points(double radius, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vector3> points;
  sample(-kReach, kReach, random, [&](double x, double along) {
    if (std::fabs(along) > 0.5 * kPi * radius) return;
    points.push_back({x, radius * std::sin(along / radius), radius * std::cos(along / radius) - radius});
  });
  return points;
}

std::vector<Vector3> moved(std::vector<Vector3> points, const Vector3& by) {
  for (Vector3& p : points) {
    for (int axis = 0; axis < 3; ++axis) p[axis] += by[axis];
  }
  return points;
}

}  // namespace arris::test
