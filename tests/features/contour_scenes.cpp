#include "contour_scenes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <tuple>

namespace arris::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

class Builder {
 public:
  explicit Builder(const Sampling& sampling) : sampling_(sampling), random_(sampling.seed) {
    scene_.spacing = sampling.spacing;
  }

  /// Samples the rectangle [0, width] x [0, height] where keep(u, v) holds, placed by at(u, v).
  void surface(double width, double height, const std::function<bool(double, double)>& keep,
               const std::function<Point(double, double)>& at) {
    const double s = sampling_.spacing;
    const double first = 0.5 - 0.5 * sampling_.jitter;
    const auto columns = static_cast<int>(std::lround(width / s));
    const auto rows = static_cast<int>(std::lround(height / s));
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::normal_distribution<double> noise(0.0, 1.0);
    for (int i = 0; i < columns; ++i) {
      for (int j = 0; j < rows; ++j) {
        const double ju = unit(random_);
        const double jv = unit(random_);
        const double u = sampling_.random ? ju * width : (i + first + sampling_.jitter * ju) * width / columns;
        const double v = sampling_.random ? jv * height : (j + first + sampling_.jitter * jv) * height / rows;
        if (!keep(u, v)) continue;
        Point p = at(u, v);
        for (double& c : p) c += sampling_.noise * s * noise(random_);
        scene_.points.push_back(p);
        scene_.faces.push_back(faces_);
      }
    }
    ++faces_;
  }

  void curve(double length, const std::function<Point(double)>& at) {
    const auto samples = static_cast<int>(std::ceil(2.0 * length / sampling_.spacing));
    for (int i = 0; i <= samples; ++i) scene_.truth.push_back(at(length * i / samples));
  }
  void segment(const Point& a, const Point& b) {
    const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    curve(length, [&](double t) {
      Point p;
      for (std::size_t c = 0; c < 3; ++c) p[c] = a[c] + (b[c] - a[c]) * t / length;
      return p;
    });
  }
  void circle(double radius, double z) {
    curve(2.0 * kPi * radius, [&](double t) {
      return Point{radius * std::cos(t / radius), radius * std::sin(t / radius), z};
    });
  }

  Scene take() { return std::move(scene_); }

 private:
  Sampling sampling_;
  std::mt19937_64 random_;
  std::uint32_t faces_ = 0;
  Scene scene_;
};

bool everywhere(double, double) {
  return true;
}

}  // namespace

Scene block_scene(const Sampling& sampling) {
  constexpr double kHalf = 12.0;
  constexpr double kHalfHeight = 6.0;
  constexpr double kRadius = 7.0;
  constexpr double kCylinder = 6.0;
  Builder b(sampling);
  for (const double sign : {-1.0, 1.0}) {
    const double z = sign * kHalfHeight;
    const double cap = sign * (kHalfHeight + kCylinder);
    b.surface(
        2 * kHalf, 2 * kHalf, [&](double u, double v) { return std::hypot(u - kHalf, v - kHalf) > kRadius; },
        [&](double u, double v) {
          return Point{u - kHalf, v - kHalf, z};
        });
    b.surface(
        2 * kRadius, 2 * kRadius, [&](double u, double v) { return std::hypot(u - kRadius, v - kRadius) < kRadius; },
        [&](double u, double v) {
          return Point{u - kRadius, v - kRadius, cap};
        });
    b.surface(2 * kPi * kRadius, kCylinder, everywhere, [&](double u, double v) {
      return Point{kRadius * std::cos(u / kRadius), kRadius * std::sin(u / kRadius), z + sign * v};
    });
    b.surface(2 * kHalf, 2 * kHalfHeight, everywhere, [&](double u, double v) {
      return Point{u - kHalf, sign * kHalf, v - kHalfHeight};
    });
    b.surface(2 * kHalf, 2 * kHalfHeight, everywhere, [&](double u, double v) {
      return Point{sign * kHalf, u - kHalf, v - kHalfHeight};
    });
    b.circle(kRadius, z);
    b.circle(kRadius, cap);
    for (const double other : {-1.0, 1.0}) {
      b.segment({-kHalf, other * kHalf, z}, {kHalf, other * kHalf, z});
      b.segment({other * kHalf, -kHalf, z}, {other * kHalf, kHalf, z});
      b.segment({sign * kHalf, other * kHalf, -kHalfHeight}, {sign * kHalf, other * kHalf, kHalfHeight});
    }
  }
  return b.take();
}

Scene plates_scene(const Sampling& sampling, double gap) {
  const double half = 30.0 * sampling.spacing;
  const double hole = 12.0 * sampling.spacing;
  Builder b(sampling);
  for (const double z : {0.0, gap * sampling.spacing}) {
    b.surface(
        2 * half, 2 * half, [&](double u, double v) { return std::hypot(u - half, v - half) > hole; },
        [&](double u, double v) {
          return Point{u - half, v - half, z};
        });
    b.circle(hole, z);
    for (const double sign : {-1.0, 1.0}) {
      b.segment({-half, sign * half, z}, {half, sign * half, z});
      b.segment({sign * half, -half, z}, {sign * half, half, z});
    }
  }
  return b.take();
}

TilePoints tile_of(const Scene& scene, double step) {
  std::map<LatticePoint, std::uint32_t> entry_of;
  TilePoints tile;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const Point& p = scene.points[i];
    const LatticePoint at{static_cast<std::int32_t>(std::lround(p[0] / step)),
                          static_cast<std::int32_t>(std::lround(p[1] / step)),
                          static_cast<std::int32_t>(std::lround(p[2] / step))};
    const auto [found, fresh] = entry_of.try_emplace(at, static_cast<std::uint32_t>(tile.positions.size()));
    if (fresh) {
      tile.positions.push_back(at);
      tile.ids.push_back(i);
    } else {
      tile.duplicates.emplace_back(i, found->second);
    }
  }
  tile.core.min = {INT32_MIN, INT32_MIN, INT32_MIN};
  tile.core.max = {std::int64_t{INT32_MAX} + 1, std::int64_t{INT32_MAX} + 1, std::int64_t{INT32_MAX} + 1};
  tile.covered = tile.core;
  return tile;
}

namespace {

/// Buckets of the size of the tolerance: a point within it lies in one of 27.
class Buckets {
 public:
  Buckets(const std::vector<Point>& points, double cell) : points_(points), cell_(cell) {
    for (std::size_t i = 0; i < points.size(); ++i) cells_[key(points[i], 0, 0, 0)].push_back(i);
  }
  bool any_within(const Point& p, double distance) const {
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          const auto found = cells_.find(key(p, x, y, z));
          if (found == cells_.end()) continue;
          for (const std::size_t i : found->second) {
            const Point& q = points_[i];
            if (std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) <= distance) return true;
          }
        }
      }
    }
    return false;
  }

 private:
  using Key = std::tuple<long, long, long>;
  Key key(const Point& p, int x, int y, int z) const {
    return {std::lround(std::floor(p[0] / cell_)) + x, std::lround(std::floor(p[1] / cell_)) + y,
            std::lround(std::floor(p[2] / cell_)) + z};
  }
  const std::vector<Point>& points_;
  double cell_;
  std::map<Key, std::vector<std::size_t>> cells_;
};

double share_within(const std::vector<Point>& of, const std::vector<Point>& others, double distance) {
  if (of.empty()) return 0.0;
  const Buckets buckets(others, distance);
  const auto hits =
      std::count_if(of.begin(), of.end(), [&](const Point& p) { return buckets.any_within(p, distance); });
  return static_cast<double>(hits) / static_cast<double>(of.size());
}

}  // namespace

Score score(const Scene& scene, const ContourRecords& records, std::uint8_t classes, double tolerance) {
  std::vector<Point> detections;
  for (const ContourRecord& record : records) {
    if (record.classes & classes) detections.push_back(scene.points[record.id]);
  }
  return {share_within(detections, scene.truth, tolerance), share_within(scene.truth, detections, tolerance)};
}

}  // namespace arris::test
