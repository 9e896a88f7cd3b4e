#include "merge/loop_containment.h"

#include <algorithm>
#include <cmath>

namespace arris::merge {

LoopContainment::LoopContainment(std::span<const Loop> loops, std::span<const PlanePosition> at) : at_(at) {
  std::size_t edges = 0;
  std::int64_t high = INT64_MIN;
  low_ = INT64_MAX;
  for (const Loop& loop : loops) {
    edges += loop.size();
    for (const std::uint32_t v : loop) {
      low_ = std::min(low_, at_[v].y);
      high = std::max(high, at_[v].y);
    }
  }
  if (edges == 0) return;
  const auto count = static_cast<std::size_t>(std::sqrt(static_cast<double>(edges))) + 1;
  height_ = (high - low_) / static_cast<std::int64_t>(count) + 1;
  strips_.resize(count);
  for (std::uint32_t l = 0; l < loops.size(); ++l) {
    for (std::size_t i = 0; i < loops[l].size(); ++i) {
      const Edge edge{loops[l][i], loops[l][(i + 1) % loops[l].size()], l};
      const auto [from, to] = std::minmax({strip(at_[edge.from].y), strip(at_[edge.to].y)});
      for (std::size_t s = from; s <= to; ++s) strips_[s].push_back(edge);
    }
  }
}

std::size_t LoopContainment::strip(std::int64_t y) const {
  return static_cast<std::size_t>((y - low_) / height_);
}

std::vector<std::uint32_t> LoopContainment::around(std::uint32_t a, std::uint32_t b) const {
  const PlanePosition twice{at_[a].x + at_[b].x, at_[a].y + at_[b].y};
  std::vector<std::uint32_t> crossed;
  const std::int64_t y = at_[a].y + (at_[b].y - at_[a].y) / 2;
  if (strips_.empty() || y < low_ || strip(y) >= strips_.size()) return crossed;
  for (const Edge& edge : strips_[strip(y)]) {
    const PlanePosition from{2 * at_[edge.from].x, 2 * at_[edge.from].y};
    const PlanePosition to{2 * at_[edge.to].x, 2 * at_[edge.to].y};
    if ((from.y <= twice.y) == (to.y <= twice.y)) continue;  // A vertex belongs to the edge above it.
    const Area left = turn(from, to, twice);
    if (from.y < to.y ? left < 0 : left > 0) crossed.push_back(edge.loop);  // The edge is to the left of the place.
  }
  std::sort(crossed.begin(), crossed.end());
  std::vector<std::uint32_t> holders;
  for (std::size_t begin = 0; begin < crossed.size();) {
    std::size_t end = begin;
    while (end < crossed.size() && crossed[end] == crossed[begin]) ++end;
    if ((end - begin) % 2 == 1) holders.push_back(crossed[begin]);
    begin = end;
  }
  return holders;
}

}  // namespace arris::merge
