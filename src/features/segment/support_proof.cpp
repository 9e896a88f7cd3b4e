#include "features/segment/support_proof.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace arris {
namespace {

constexpr std::size_t kGrain = 4096;
/// Rounding of a distance must not make a ball too small.
constexpr double kRound = 1.0 + 1e-12;
/// Where too few neighbours are in sight, the next look goes this many times as far.
constexpr double kFarther = 2.0;

}  // namespace

double SupportProof::distance(std::uint32_t a, std::uint32_t b) const {
  return std::sqrt(static_cast<double>(squared_distance(tree_.position(a), tree_.position(b)))) * kRound;
}

SupportProof::Depth SupportProof::depth_in(const LatticeBox& covered) const {
  return [this, &covered](std::uint32_t slot) { return static_cast<double>(covered.depth(tree_.position(slot))); };
}

SupportProof::Depth SupportProof::depth_around(std::uint32_t slot, double radius) const {
  return [this, slot, radius](std::uint32_t other) { return radius - distance(slot, other); };
}

/// Those that are bad, or have a neighbour that is.
std::vector<std::uint8_t> SupportProof::with_bad_neighbours(const std::vector<std::uint8_t>& bad) const {
  std::vector<std::uint8_t> wider = bad;
  parallel_for_chunks(tree_.size(), kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      for (const std::uint32_t neighbour : points_.neighbours(static_cast<std::uint32_t>(i)))
        wider[i] |= bad[neighbour];
    }
  });
  return wider;
}

std::vector<std::uint32_t> SupportProof::unproven(const std::vector<std::uint8_t>& is_query,
                                                  const LatticeBox& covered) const {
  std::vector<std::uint8_t> bad(tree_.size());
  parallel_for_chunks(tree_.size(), kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto slot = static_cast<std::uint32_t>(i);
      bad[i] = points_.state(slot) != ShapeState::kUnasked &&
               points_.reach_of(slot) >= static_cast<double>(covered.depth(tree_.position(slot)));
    }
  });
  std::vector<std::uint32_t> slots;
  if (std::find(bad.begin(), bad.end(), 1) == bad.end()) return slots;
  for (int ring = 0; ring < rings_; ++ring) bad = with_bad_neighbours(bad);
  for (std::uint32_t slot = 0; slot < tree_.size(); ++slot)
    if (is_query[slot] && bad[slot]) slots.push_back(slot);
  return slots;
}

double SupportProof::reach(std::uint32_t slot, const Depth& depth) const {
  const double most = points_.max_reach_steps();
  const double own = points_.reach_of(slot);
  const auto inside = [&](std::uint32_t of, double radius) { return radius < depth(of); };
  const auto farther = [&](std::uint32_t of) { return kFarther * std::max(depth(of), 0.0); };
  if (!inside(slot, own)) {
    if (points_.full(slot)) return own;
    return std::min(most, farther(slot));
  }
  struct Ball {
    std::uint32_t slot;
    double radius;
  };
  std::vector<Ball> ring{{slot, own}};
  for (int i = 0; i < rings_; ++i) {
    double reach = 0.0;
    bool whole = true;
    std::vector<Ball> next;
    for (const Ball& ball : ring) {
      for (const std::uint32_t neighbour : points_.neighbours(ball.slot)) {
        const double bound = std::min(most, distance(ball.slot, neighbour) + ball.radius);
        const bool bounded = points_.wanted(neighbour) <= points_.neighbours(ball.slot).size();
        const double radius = bounded ? std::min(points_.reach_of(neighbour), bound) : points_.reach_of(neighbour);
        next.push_back({neighbour, radius});
        double look = radius;
        if (!inside(neighbour, radius)) {
          whole = false;
          if (!points_.full(neighbour)) look = std::min(radius, std::max(bound, farther(neighbour)));
        }
        reach = std::max(reach, distance(slot, neighbour) + look);
      }
    }
    if (!whole) return reach;
    ring = std::move(next);
  }
  return 0.0;
}

// A ball of radius b around the query that holds as many other points as any point may want, and the query itself,
// holds as many other points of each point. So a point at distance d finds all its neighbours within d + b, and a ring
// that ends at r is followed by one that ends at 2 r + b.
std::optional<SupportProof::Bound> SupportProof::bound(std::uint32_t slot) const {
  const std::optional<double> ball = points_.ball_of_most(slot);
  if (!ball) return std::nullopt;
  double most = *ball;
  for (int ring = 0; ring < rings_; ++ring) most = 2.0 * most + *ball;
  return Bound{*ball, most};
}

}  // namespace arris
