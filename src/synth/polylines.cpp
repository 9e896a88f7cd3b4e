#include "synth/polylines.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace arris::synth {

namespace {

using evaluate::Vec3;

struct End {
  std::uint64_t key = 0;
  std::uint32_t segment = 0;
  bool second = false;
  friend bool operator<(const End& x, const End& y) {
    return std::tie(x.key, x.segment, x.second) < std::tie(y.key, y.segment, y.second);
  }
};

class Joiner {
 public:
  explicit Joiner(const std::vector<KeyedSegment>& segments) : segments_(segments), used_(segments.size(), false) {
    for (std::uint32_t i = 0; i < segments.size(); ++i) {
      ends_.push_back({segments[i].key_a, i, false});
      ends_.push_back({segments[i].key_b, i, true});
    }
    std::sort(ends_.begin(), ends_.end());
  }

  std::vector<std::vector<Vec3>> run() {
    std::vector<std::vector<Vec3>> lines;
    // Open chains from their ends first; what is left are rings.
    for (const bool open : {true, false}) {
      for (std::uint32_t i = 0; i < segments_.size(); ++i) {
        if (used_[i]) continue;
        if (!open || ends_here(segments_[i].key_a)) {
          lines.push_back(follow(i, false));
        } else if (ends_here(segments_[i].key_b)) {
          lines.push_back(follow(i, true));
        }
      }
    }
    return lines;
  }

 private:
  auto at(std::uint64_t key) const {
    const auto low = std::lower_bound(ends_.begin(), ends_.end(), End{key, 0, false});
    auto high = low;
    while (high != ends_.end() && high->key == key) ++high;
    return std::pair{low, high};
  }
  bool ends_here(std::uint64_t key) const {
    const auto [low, high] = at(key);
    return high - low != 2;
  }

  std::vector<Vec3> follow(std::uint32_t segment, bool backwards) {
    std::vector<Vec3> line{backwards ? segments_[segment].b : segments_[segment].a};
    while (true) {
      const KeyedSegment& s = segments_[segment];
      used_[segment] = true;
      line.push_back(backwards ? s.a : s.b);
      const auto [low, high] = at(backwards ? s.key_a : s.key_b);
      if (high - low != 2) return line;
      const End& next = low->segment == segment ? *(low + 1) : *low;
      if (used_[next.segment]) return line;
      segment = next.segment;
      backwards = next.second;
    }
  }

  const std::vector<KeyedSegment>& segments_;
  std::vector<bool> used_;
  std::vector<End> ends_;
};

double distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double squared = dot(along, along);
  const double t = squared > 0.0 ? std::clamp(dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
  return norm(p - a - t * along);
}

}  // namespace

std::vector<std::vector<Vec3>> join_segments(const std::vector<KeyedSegment>& segments) {
  return Joiner(segments).run();
}

std::vector<Vec3> simplify(const std::vector<Vec3>& line, double tolerance) {
  if (line.size() < 3) return line;
  std::vector<bool> kept(line.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> waiting{{0, line.size() - 1}};
  while (!waiting.empty()) {
    const auto [first, last] = waiting.back();
    waiting.pop_back();
    std::size_t farthest = first;
    double most = tolerance;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double d = distance(line[i], line[first], line[last]);
      if (d > most) {
        most = d;
        farthest = i;
      }
    }
    if (farthest == first) continue;
    kept[farthest] = true;
    waiting.emplace_back(first, farthest);
    waiting.emplace_back(farthest, last);
  }
  std::vector<Vec3> result;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (kept[i]) result.push_back(line[i]);
  }
  return result;
}

}  // namespace arris::synth
