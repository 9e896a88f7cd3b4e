#include "features/segment/support_proof.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"

namespace arris {
namespace {

/// Slots that are looked at together, which lie close together.
constexpr std::size_t kGrain = 256;
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

/// Slots whose support is not whole, with what tells of most others that no neighbour of theirs is among them.
class SupportProof::BadSlots {
 public:
  BadSlots(const SupportProof& proof, const LatticeBox& covered)
      : proof_(proof), covered_(covered), bad_(proof.tree_.size(), 0), blocks_((bad_.size() + kGrain - 1) / kGrain) {
    parallel_for_chunks(bad_.size(), kGrain, [&](std::size_t first, std::size_t last) {
      Block& block = blocks_[first / kGrain];
      const std::optional<double> reach = proof_.points_.most_reach(first, last);
      if (!reach) return;
      block.shallowest = least_depth(first, last) - *reach;
      if (block.shallowest > 0.0) return;  // All reaches are less than all depths.
      for (std::size_t slot = first; slot < last; ++slot) judge(block, static_cast<std::uint32_t>(slot));
    });
  }

  bool any() const { return deepest() > kNone; }
  bool operator[](std::uint32_t slot) const { return bad_[slot] != 0; }

  /// Those with a bad neighbour are bad too. A neighbour is as deep in what is covered as the point is, less the
  /// distance: where that is deeper than any that is bad, there is nothing to look for.
  void widen() {
    const double deepest_before = deepest();
    const PageVector<std::uint8_t> before = bad_;
    for_each_block(
        [&](std::size_t block, std::uint32_t slot) {
          if (before[slot] != 0) return;
          for (const std::uint32_t neighbour : proof_.points_.neighbours(slot)) {
            if (before[neighbour] == 0) continue;
            mark(blocks_[block], slot, depth_of(slot));
            return;
          }
        },
        deepest_before);
  }

 private:
  static constexpr double kNone = -1.0;
  struct Block {
    double shallowest = std::numeric_limits<double>::infinity();  ///< No neighbour is less deep.
    double deepest = kNone;                                       ///< Of those that are bad.
  };

  double depth_of(std::uint32_t slot) const { return static_cast<double>(covered_.depth(proof_.tree_.position(slot))); }
  /// Of slots that were asked for, of which there is one at least: that of the corners of their box.
  double least_depth(std::size_t first, std::size_t last) const {
    constexpr std::int32_t kLowest = std::numeric_limits<std::int32_t>::min();
    constexpr std::int32_t kHighest = std::numeric_limits<std::int32_t>::max();
    LatticePoint low{kHighest, kHighest, kHighest}, high{kLowest, kLowest, kLowest};
    for (std::size_t slot = first; slot < last; ++slot) {
      if (proof_.points_.state(static_cast<std::uint32_t>(slot)) == ShapeState::kUnasked) continue;
      const LatticePoint p = proof_.tree_.position(slot);
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return static_cast<double>(std::min(covered_.depth(low), covered_.depth(high)));
  }
  void judge(Block& block, std::uint32_t slot) {
    const TileNeighbourhoods& points = proof_.points_;
    if (points.state(slot) == ShapeState::kUnasked) return;
    const double depth = depth_of(slot);
    if (!(points.reach_of(slot) < depth)) mark(block, slot, depth);
  }
  void mark(Block& block, std::uint32_t slot, double depth) {
    bad_[slot] = 1;
    block.deepest = std::max(block.deepest, depth);
  }
  double deepest() const {
    double most = kNone;
    for (const Block& block : blocks_) most = std::max(most, block.deepest);
    return most;
  }
  /// Calls use(block, slot) in blocks that have neighbours at `depth` or less deep.
  template <class Use>
  void for_each_block(Use&& use, double depth = std::numeric_limits<double>::infinity()) {
    parallel_for_chunks(bad_.size(), kGrain, [&](std::size_t first, std::size_t last) {
      const std::size_t block = first / kGrain;
      if (blocks_[block].shallowest > depth) return;
      for (std::size_t slot = first; slot < last; ++slot) use(block, static_cast<std::uint32_t>(slot));
    });
  }

  const SupportProof& proof_;
  const LatticeBox& covered_;
  PageVector<std::uint8_t> bad_;
  std::vector<Block> blocks_;
};

std::vector<std::uint32_t> SupportProof::unproven(std::span<const std::uint8_t> is_query,
                                                  const LatticeBox& covered) const {
  BadSlots bad(*this, covered);
  std::vector<std::uint32_t> slots;
  if (!bad.any()) return slots;
  for (int ring = 0; ring < rings_; ++ring) bad.widen();
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
        const bool bounded = points_.wanted(neighbour) <= points_.count(ball.slot);
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
