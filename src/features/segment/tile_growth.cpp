#include "features/segment/tile_growth.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <unordered_map>

#include "core/disjoint_sets.h"
#include "core/parallel.h"
#include "features/neighbourhood/point_tree.h"
#include "features/segment/intensity_smoothing.h"
#include "features/segment/likeness.h"
#include "features/segment/support_proof.h"
#include "features/segment/tile_neighbourhoods.h"

namespace arris {
namespace {

constexpr std::size_t kGrain = 4096;

constexpr std::uint8_t kNoRing = 255;

/// Later sums of distances round differently.
constexpr double kRoundMore = 1.0 + 1e-8;

/// Works out one tile. Points go by their slots in the tree.
class Grower {
 public:
  Grower(const TilePoints& tile, std::span<const std::uint8_t> intensities, const Lattice& lattice,
         const SegmentParameters& parameters, std::optional<std::span<const PlacedQuery>> queries)
      : parameters_(parameters),
        covered_(tile.covered),
        tree_(tile.positions, tile.ids),
        points_(tree_, lattice, parameters),
        is_query_(tree_.size(), 0),
        intensities_(slot_intensities(intensities)),
        likeness_(points_, intensities_, parameters) {
    choose_queries(tile, queries);
  }

  TileGrowth run(const FrontierSink& frontier) {
    compute_rings();
    settle_unproven();
    return grow(frontier);
  }

  std::uint64_t run_proven(const FrontierSink& frontier) {
    compute_rings();
    for (const std::uint32_t slot : SupportProof(tree_, points_, rings()).unproven(is_query_, covered_))
      is_query_[slot] = 0;
    grow(frontier);
    return static_cast<std::uint64_t>(std::count(is_query_.begin(), is_query_.end(), 1));
  }

 private:
  TileGrowth grow(const FrontierSink& frontier) {
    if (!parameters_.published && !intensities_.empty()) {
      intensities_ = smoothed_intensities(points_, intensities_);
      likeness_.use_intensities(intensities_);
    }
    choose_growing();
    find_links();
    number_components();
    write_frontier(frontier);
    return std::move(growth_);
  }

  /// Some neighbours are needed, not all: those of queries. Two more rings around them, or one.
  int rings() const { return parameters_.published ? 1 : 2; }

  PageVector<std::uint8_t> slot_intensities(std::span<const std::uint8_t> of_entry) const {
    PageVector<std::uint8_t> of_slot(parameters_.intensity ? of_entry.size() : 0);
    for (std::size_t slot = 0; slot < of_slot.size(); ++slot) of_slot[slot] = of_entry[tree_.entry(slot)];
    return of_slot;
  }

  void choose_queries(const TilePoints& tile, std::optional<std::span<const PlacedQuery>> queries) {
    if (!queries) {
      for (std::size_t slot = 0; slot < tree_.size(); ++slot)
        is_query_[slot] = tile.core.contains(tree_.position(slot));
      return;
    }
    std::unordered_map<std::uint32_t, std::int64_t> listed;
    for (const PlacedQuery& query : *queries) listed.emplace(query.entry, query.reach_steps);
    for (std::uint32_t slot = 0; slot < tree_.size(); ++slot) {
      const auto found = listed.find(tree_.entry(slot));
      if (found == listed.end()) continue;
      is_query_[slot] = 1;
      reach_.emplace_back(slot, found->second);
    }
  }

  template <class Use>
  void for_each_query(Use&& use) const {
    for (std::uint32_t slot = 0; slot < tree_.size(); ++slot)
      if (is_query_[slot]) use(slot);
  }

  void compute_rings() {
    ring_.resize(tree_.size());
    for (std::uint32_t slot = 0; slot < tree_.size(); ++slot) ring_[slot] = is_query_[slot] ? 0 : kNoRing;
    points_.compute(is_query_);
    for (std::uint8_t ring = 0; ring < rings(); ++ring)
      if (mark_neighbours(ring)) points_.compute(wanted_of(ring + 1));
  }

  /// Those of a ring that are in none get into the next; false if there are none.
  bool mark_neighbours(std::uint8_t ring) {
    std::atomic<bool> any{false};
    parallel_for_chunks(tree_.size(), kGrain, [&](std::size_t first, std::size_t last) {
      bool more = false;
      for (std::size_t i = first; i < last; ++i) {
        if (std::atomic_ref(ring_[i]).load(std::memory_order_relaxed) != ring) continue;
        for (const std::uint32_t neighbour : points_.neighbours(static_cast<std::uint32_t>(i))) {
          // Whoever marks one, the mark is the same.
          const std::atomic_ref mark(ring_[neighbour]);
          if (mark.load(std::memory_order_relaxed) != kNoRing) continue;
          mark.store(ring + 1, std::memory_order_relaxed);
          more = true;
        }
      }
      if (more) any = true;
    });
    return any;
  }

  PageVector<std::uint8_t> wanted_of(std::uint8_t ring) const {
    PageVector<std::uint8_t> wanted(ring_.size());
    for (std::size_t slot = 0; slot < ring_.size(); ++slot) wanted[slot] = ring_[slot] == ring;
    return wanted;
  }

  /// Queries whose support is not whole are none from here on.
  void settle_unproven() {
    const SupportProof proof(tree_, points_, rings());
    const auto leave = [&](std::uint32_t slot, double reach, double most = 0.0) {
      is_query_[slot] = 0;
      const auto steps = [](double r) { return static_cast<std::int64_t>(std::ceil(r * (1.0 + 1e-9))) + 1; };
      growth_.unproven.push_back({tree_.id(slot), tree_.position(slot), steps(reach), most > 0.0 ? steps(most) : 0});
    };
    if (reach_.empty()) {
      const SupportProof::Depth in_tile = proof.depth_in(covered_);
      for (const std::uint32_t slot : proof.unproven(is_query_, covered_)) {
        const double reach = proof.reach(slot, in_tile);
        if (const auto bound = proof.bound(slot))
          leave(slot, std::max(reach, bound->first), std::max(reach, kRoundMore * bound->most));
        else
          leave(slot, reach);
      }
    }
    for (const auto& [slot, reach] : reach_) {
      const double needed = proof.reach(slot, proof.depth_around(slot, static_cast<double>(reach)));
      if (needed > 0.0) leave(slot, needed);
    }
    std::sort(growth_.unproven.begin(), growth_.unproven.end(),
              [](const UnprovenQuery& a, const UnprovenQuery& b) { return a.id < b.id; });
  }

  bool agrees(std::uint32_t slot) const {
    const auto neighbours = points_.neighbours(slot);
    const auto needed =
        static_cast<std::size_t>(std::ceil(parameters_.least_agreement() * static_cast<double>(neighbours.size())));
    std::size_t like = 0;
    for (std::size_t i = 0; i < neighbours.size() && like < needed; ++i)
      like += points_.state(neighbours[i]) == ShapeState::kShaped && likeness_.alike(slot, neighbours[i]);
    return like >= needed;
  }

  /// Growing is asked of queries and their neighbours only.
  void choose_growing() {
    grows_.assign(tree_.size(), 0);
    parallel_for_chunks(tree_.size(), kGrain, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const auto slot = static_cast<std::uint32_t>(i);
        if (ring_[slot] > 1 || points_.state(slot) != ShapeState::kShaped) continue;
        if (!(points_.shape(slot).variation < static_cast<float>(parameters_.curvature))) continue;
        grows_[slot] = parameters_.published || agrees(slot);
      }
    });
  }

  /// Whether all are seen to be linked with the points of `root` at first sight: what most points end with.
  bool all_below(std::uint32_t root, const NeighbourList& neighbours) const {
    for (const std::uint32_t neighbour : neighbours)
      if (sets_.parent(neighbour) != root) return false;
    return true;
  }

  void find_links() {
    sets_ = DisjointSets(tree_.size());
    numbered_.assign(tree_.size(), 0);
    among_own_.assign(tree_.size(), 0);
    for_each_query([&](std::uint32_t slot) {
      if (points_.state(slot) != ShapeState::kShaped) {
        ++growth_.isolated;
        return;
      }
      std::uint32_t root = sets_.find(slot);
      const NeighbourList neighbours = points_.neighbours(slot);
      if (all_below(root, neighbours)) {
        among_own_[slot] = 1;
        return;
      }
      bool all_linked = true;
      for (const std::uint32_t neighbour : neighbours) {
        if (sets_.parent(neighbour) == root) continue;  // Most are linked already.
        const bool both = grows_[slot] && grows_[neighbour];
        if (both && sets_.find(neighbour) == root) continue;
        if (points_.state(neighbour) != ShapeState::kShaped || !(grows_[slot] || grows_[neighbour]) ||
            !likeness_.alike(slot, neighbour)) {
          all_linked = false;
          continue;
        }
        if (both) {
          numbered_[slot] = numbered_[neighbour] = 1;
          sets_.join(slot, neighbour);
          root = sets_.find(slot);
          continue;
        }
        all_linked = false;
        if (parameters_.published) {
          const auto [joins, via] = grows_[slot] ? std::pair(neighbour, slot) : std::pair(slot, neighbour);
          numbered_[via] = 1;
          offers_.push_back({joins, via});
        }
      }
      among_own_[slot] = all_linked;
    });
  }

  void number_components() {
    component_.assign(tree_.size(), 0);
    growth_.members.reserve(static_cast<std::size_t>(std::count(numbered_.begin(), numbered_.end(), 1)));
    for (std::uint32_t slot = 0; slot < tree_.size(); ++slot) {
      if (!numbered_[slot]) continue;
      const std::uint32_t root = sets_.find(slot);  // The smallest of the set: numbered first, if it is numbered.
      if (component_[root] == 0) {
        growth_.sizes.push_back(0);
        growth_.discs.push_back(0);
        component_[root] = static_cast<std::uint32_t>(growth_.sizes.size());
      }
      component_[slot] = component_[root];
      const TileGrowth::Member member{tree_.id(slot), component_[slot], disc_of(slot)};
      if (is_query_[slot]) {
        ++growth_.sizes[component_[slot] - 1];
        growth_.discs[component_[slot] - 1] += member.disc;
        growth_.members.push_back(member);
      } else {
        growth_.touched.push_back(member);
      }
    }
    for (const auto& [joins, via] : offers_) {
      growth_.offers.push_back(
          {tree_.id(joins), tree_.id(via), static_cast<float>(likeness_.alignment(joins, via)), component_[via]});
    }
  }

  std::uint32_t disc_of(std::uint32_t slot) const {
    const std::size_t count = points_.count(slot);
    if (count == 0) return 0;
    const std::uint64_t d2 = squared_distance(tree_.position(slot), tree_.position(points_.last_neighbour(slot)));
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(d2 / count, 0xffffffffU));
  }

  bool inside_component(std::uint32_t slot) const {
    const std::uint32_t component = component_[slot];
    if (component == 0 || growth_.sizes[component - 1] < parameters_.least_component()) return false;
    if (among_own_[slot]) return true;
    for (const std::uint32_t neighbour : points_.neighbours(slot))
      if (component_[neighbour] != component) return false;
    return true;
  }

  void write_frontier(const FrontierSink& sink) {
    constexpr std::size_t kBlockWords = 1 << 16;
    const std::size_t stride = parameters_.most_neighbours();
    std::vector<std::uint32_t> words;
    for_each_query([&](std::uint32_t slot) {
      if (inside_component(slot)) return;
      const LatticePoint p = tree_.position(slot);
      words.insert(words.end(), {static_cast<std::uint32_t>(tree_.id(slot)), static_cast<std::uint32_t>(p.x),
                                 static_cast<std::uint32_t>(p.y), static_cast<std::uint32_t>(p.z)});
      const auto neighbours = points_.neighbours(slot);
      for (const std::uint32_t neighbour : neighbours) words.push_back(static_cast<std::uint32_t>(tree_.id(neighbour)));
      words.insert(words.end(), stride - neighbours.size(), TileGrowth::kNoId);
      if (words.size() < kBlockWords) return;
      sink(words);
      words.clear();
    });
    if (!words.empty()) sink(words);
  }

  const SegmentParameters& parameters_;
  const LatticeBox& covered_;
  PointTree tree_;
  TileNeighbourhoods points_;
  PageVector<std::uint8_t> is_query_;
  PageVector<std::uint8_t> ring_;  ///< 0: asked as a query, 1: a neighbour of one, and so on.
  std::vector<std::pair<std::uint32_t, std::int64_t>> reach_;  ///< Slot and reach of listed queries.
  PageVector<std::uint8_t> intensities_;                       ///< Per slot.
  Likeness likeness_;
  PageVector<std::uint8_t> grows_;
  DisjointSets sets_;
  PageVector<std::uint8_t> numbered_;   ///< Has a link or makes an offer.
  PageVector<std::uint8_t> among_own_;  ///< Every neighbour was seen to be in the same set.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> offers_;
  PageVector<std::uint32_t> component_;
  TileGrowth growth_;
};

}  // namespace

TileGrowth grow_tile(const TilePoints& tile, std::span<const std::uint8_t> intensities, const Lattice& lattice,
                     const SegmentParameters& parameters, const FrontierSink& frontier,
                     std::optional<std::span<const PlacedQuery>> queries) {
  if (tile.positions.empty()) return {};
  return Grower(tile, intensities, lattice, parameters, queries).run(frontier);
}

std::uint64_t grow_proven(const TilePoints& tile, std::span<const std::uint8_t> intensities, const Lattice& lattice,
                          const SegmentParameters& parameters, const FrontierSink& frontier) {
  if (tile.positions.empty()) return 0;
  return Grower(tile, intensities, lattice, parameters, std::nullopt).run_proven(frontier);
}

double growth_bytes_per_point(const SegmentParameters& parameters) {
  // Tree 27, shapes, counts and states 19, flags and intensities 9, sets and components 8, members 16; neighbours, as
  // of points that fill space (of those on surfaces 2.2).
  constexpr double kNeighbourBytes = 2.6;
  const double k = static_cast<double>(parameters.most_neighbours());
  return 27.0 + 19.0 + 9.0 + 8.0 + 16.0 + kNeighbourBytes * k;
}
const double kGrowthBytesPerThread = 3.0 * 1024 * 1024;

}  // namespace arris
