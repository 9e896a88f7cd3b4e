#pragma once
/// @file Short ways to get at scenes in tests.

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "synth/scene.h"

namespace arris::synth {

inline SceneRequest request_of(const std::string& scene, std::uint64_t points = 0) {
  SceneRequest request;
  request.scene = scene;
  request.points = points;
  return request;
}

inline std::vector<io::FreshPoint> all_points(const Scene& scene, std::size_t block_points = 100'000) {
  std::vector<io::FreshPoint> points;
  const auto stream = scene.stream(block_points);
  for (std::vector<io::FreshPoint> block; stream->next(block);) points.insert(points.end(), block.begin(), block.end());
  return points;
}

inline bool same(const io::FreshPoint& a, const io::FreshPoint& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.intensity == b.intensity && a.classification == b.classification &&
         a.point_source_id == b.point_source_id && a.red == b.red && a.green == b.green && a.blue == b.blue;
}

inline double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

inline double standard_deviation(const std::vector<double>& values) {
  const double centre = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace arris::synth
