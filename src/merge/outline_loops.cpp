#include "merge/outline_loops.h"

#include <algorithm>

namespace arris::merge {
namespace {

constexpr std::uint32_t kNone = UINT32_MAX;

class Walk {
 public:
  Walk(std::span<const IndexedEdge> edges, std::span<const PlanePosition> at)
      : edges_(edges), at_(at), leaving_(at.size() + 1, 0), place_(at.size(), kNone), used_(edges.size(), 0) {
    for (const IndexedEdge& e : edges_) ++leaving_[e.from + 1];
    for (std::size_t v = 0; v < at_.size(); ++v) leaving_[v + 1] += leaving_[v];
  }

  std::vector<Loop> loops() {
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      if (used_[e] == 0) walk(e);
    }
    std::sort(loops_.begin(), loops_.end());
    return std::move(loops_);
  }

 private:
  /// 0: less than half a turn clockwise from `back`, 1: half a turn, 2: more, 3: a whole one.
  int sector(std::uint32_t centre, std::uint32_t back, std::uint32_t to) const {
    const Area left = turn(at_[centre], at_[back], at_[to]);
    if (left != 0) return left < 0 ? 0 : 2;
    const PlanePosition& c = at_[centre];
    const Area ahead = static_cast<Area>(at_[back].x - c.x) * (at_[to].x - c.x) +
                       static_cast<Area>(at_[back].y - c.y) * (at_[to].y - c.y);
    return ahead < 0 ? 1 : 3;
  }
  bool sooner(std::uint32_t centre, std::uint32_t back, std::uint32_t a, std::uint32_t b) const {
    const int sector_a = sector(centre, back, a);
    const int sector_b = sector(centre, back, b);
    return sector_a != sector_b ? sector_a < sector_b : turn(at_[centre], at_[a], at_[b]) < 0;
  }
  /// The first edge clockwise from the one that came in.
  std::uint32_t next(std::uint32_t edge) const {
    const auto [back, centre] = edges_[edge];
    std::uint32_t best = kNone;
    for (std::uint32_t e = leaving_[centre]; e < leaving_[centre + 1]; ++e) {
      if (best == kNone || sooner(centre, back, edges_[e].to, edges_[best].to)) best = e;
    }
    return best;
  }

  void walk(std::uint32_t first) {
    Loop walked;
    std::uint32_t edge = first;
    while (edge != kNone && used_[edge] == 0) {
      used_[edge] = 1;
      walked.push_back(edges_[edge].from);
      edge = next(edge);
    }
    if (edge == first) split(walked);
  }

  void split(const Loop& walked) {
    Loop open;
    for (const std::uint32_t v : walked) {
      if (place_[v] != kNone) {
        const std::uint32_t begin = place_[v];
        keep(Loop(open.begin() + begin, open.end()));
        while (open.size() > begin) {
          place_[open.back()] = kNone;
          open.pop_back();
        }
      }
      place_[v] = static_cast<std::uint32_t>(open.size());
      open.push_back(v);
    }
    for (const std::uint32_t v : open) place_[v] = kNone;
    keep(std::move(open));
  }

  void keep(Loop loop) {
    if (loop.size() < 3) return;
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    loops_.push_back(std::move(loop));
  }

  std::span<const IndexedEdge> edges_;
  std::span<const PlanePosition> at_;
  std::vector<std::uint32_t> leaving_;  ///< First edge that leaves each vertex.
  std::vector<std::uint32_t> place_;    ///< Of vertices in the walk that is being split.
  std::vector<std::uint8_t> used_;
  std::vector<Loop> loops_;
};

}  // namespace

Area twice_area(const Loop& loop, std::span<const PlanePosition> at) {
  Area sum = 0;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) sum += turn(at[loop[0]], at[loop[i]], at[loop[i + 1]]);
  return sum;
}

std::vector<Loop> link_loops(std::span<const IndexedEdge> edges, std::span<const PlanePosition> at) {
  return Walk(edges, at).loops();
}

}  // namespace arris::merge
