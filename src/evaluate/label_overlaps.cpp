#include "evaluate/label_overlaps.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace arris::evaluate {

namespace {

constexpr std::uint64_t kLeakShare =
    20;  // An overlap of 1/20 of the segment or less is none for the undersegmentation.

double pairs(std::uint64_t n) {
  return 0.5 * static_cast<double>(n) * static_cast<double>(n - 1);
}

/// n log2(n / of), the contribution of n points to a negative conditional entropy.
double information(std::uint64_t n, std::uint64_t of) {
  return static_cast<double>(n) * std::log2(static_cast<double>(n) / static_cast<double>(of));
}

/// Sums over the segments, each a range of overlaps.
struct SegmentSums {
  std::uint64_t grown = 0;      ///< |S| once for each face that it reaches into.
  std::uint64_t misplaced = 0;  ///< min(|S ∩ g|, |S \ g|).
  std::uint64_t best = 0;       ///< Largest |S ∩ g|.
  double pairs_of_segments = 0.0;
  double information_of_face = 0.0;

  void add(std::span<const LabelOverlap> segment) {
    std::uint64_t size = 0, largest = 0;
    for (const LabelOverlap& overlap : segment) {
      size += overlap.points;
      largest = std::max(largest, overlap.points);
    }
    for (const LabelOverlap& overlap : segment) {
      if (kLeakShare * overlap.points > size) grown += size;
      misplaced += std::min(overlap.points, size - overlap.points);
      information_of_face += information(overlap.points, size);
    }
    best += largest;
    pairs_of_segments += pairs(size);
  }
};

template <class Counts>
std::vector<LabelOverlap> count_where(std::span<const LabelledPoint> points, const Counts& counts) {
  std::vector<std::uint64_t> keys;
  keys.reserve(points.size());
  for (const LabelledPoint& p : points) {
    if (counts(p)) keys.push_back(std::uint64_t{p.segment} << 32 | p.face);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<LabelOverlap> overlaps;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i == 0 || keys[i] != keys[i - 1])
      overlaps.push_back({static_cast<std::uint32_t>(keys[i] >> 32), static_cast<std::uint32_t>(keys[i])});
    ++overlaps.back().points;
  }
  return overlaps;
}

}  // namespace

std::vector<LabelOverlap> count_overlaps(std::span<const LabelledPoint> points) {
  return count_where(points, [](const LabelledPoint& p) { return is_judged(p) && p.segment != 0; });
}

std::vector<LabelOverlap> count_all_overlaps(std::span<const LabelledPoint> points) {
  return count_where(points, [](const LabelledPoint& p) { return has_position(p); });
}

OverlapMeasures measure_overlaps(std::span<const LabelOverlap> overlaps) {
  OverlapMeasures result;
  std::map<std::uint32_t, std::uint64_t> faces;
  for (const LabelOverlap& overlap : overlaps) {
    result.points += overlap.points;
    faces[overlap.face] += overlap.points;
  }
  result.faces = faces.size();
  if (result.points == 0) return result;
  SegmentSums sums;
  for (std::size_t begin = 0, end = 0; begin < overlaps.size(); begin = end) {
    while (end < overlaps.size() && overlaps[end].segment == overlaps[begin].segment) ++end;
    sums.add(overlaps.subspan(begin, end - begin));
    ++result.segments;
  }
  double pairs_of_both = 0.0, pairs_of_faces = 0.0, information_of_segment = 0.0;
  for (const LabelOverlap& overlap : overlaps) {
    pairs_of_both += pairs(overlap.points);
    information_of_segment += information(overlap.points, faces[overlap.face]);
  }
  for (const auto& [face, size] : faces) pairs_of_faces += pairs(size);

  const double n = static_cast<double>(result.points);
  result.undersegmentation = static_cast<double>(sums.grown) / n - 1.0;
  result.corrected_undersegmentation = static_cast<double>(sums.misplaced) / n;
  result.achievable_accuracy = static_cast<double>(sums.best) / n;
  const double by_chance = result.points > 1 ? sums.pairs_of_segments / pairs(result.points) * pairs_of_faces : 0.0;
  const double most = 0.5 * (sums.pairs_of_segments + pairs_of_faces);
  // Equal only if both partitions are one whole, or both single points.
  result.adjusted_rand = most > by_chance ? (pairs_of_both - by_chance) / (most - by_chance) : 1.0;
  result.information_split = std::max(0.0, -information_of_segment / n);
  result.information_joined = std::max(0.0, -sums.information_of_face / n);
  return result;
}

}  // namespace arris::evaluate
