#include "features/segment/tile_growth.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "features/neighbourhood/point_tree.h"
#include "features/segment/growing_points.h"
#include "features/segment/intensity_smoothing.h"
#include "features/segment/likeness.h"
#include "features/segment/query_rings.h"
#include "features/segment/support_proof.h"
#include "features/segment/tile_components.h"
#include "features/segment/tile_links.h"
#include "features/segment/tile_neighbourhoods.h"

namespace arris {
namespace {

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
        queries_(queries ? QueryRings(tree_, *queries) : QueryRings(tree_, tile.core)),
        intensities_(slot_intensities(intensities)),
        likeness_(points_, intensities_, parameters) {}

  TileGrowth run(const FrontierSink& frontier) {
    queries_.compute(points_, rings());
    settle_unproven();
    grow(frontier);
    return std::move(growth_);
  }

  std::uint64_t run_proven(const FrontierSink& frontier) {
    queries_.compute(points_, rings());
    for (const std::uint32_t slot : SupportProof(tree_, points_, rings()).unproven(queries_.are_queries(), covered_))
      queries_.leave(slot);
    grow(frontier);
    const auto are = queries_.are_queries();
    return static_cast<std::uint64_t>(std::count(are.begin(), are.end(), 1));
  }

 private:
  void grow(const FrontierSink& frontier) {
    if (!parameters_.published && !intensities_.empty()) {
      intensities_ = smoothed_intensities(points_, intensities_);
      likeness_.use_intensities(intensities_);
    }
    TileLinks links = find_links();
    growth_.isolated = links.isolated();
    TileComponents components(tree_, points_, queries_, links);
    components.measure(growth_);
    for (const auto& [joins, via] : links.offers()) {
      growth_.offers.push_back(
          {tree_.id(joins), tree_.id(via), static_cast<float>(likeness_.alignment(joins, via)), components[via]});
    }
    write_frontier(components, frontier);
    points_.forget_shapes();  // There is room for what follows.
    components.list(growth_);
  }

  TileLinks find_links() const {
    const PageVector<std::uint8_t> grows = growing_points(points_, queries_, likeness_, parameters_);
    return {points_, queries_, likeness_, grows, parameters_.published};
  }

  /// Some neighbours are needed, not all: those of queries. Two more rings around them, or one.
  int rings() const { return parameters_.published ? 1 : 2; }

  PageVector<std::uint8_t> slot_intensities(std::span<const std::uint8_t> of_entry) const {
    PageVector<std::uint8_t> of_slot(parameters_.intensity ? of_entry.size() : 0);
    for (std::size_t slot = 0; slot < of_slot.size(); ++slot) of_slot[slot] = of_entry[tree_.entry(slot)];
    return of_slot;
  }

  /// Queries whose support is not whole are none from here on.
  void settle_unproven() {
    const SupportProof proof(tree_, points_, rings());
    for (const View& view : queries_.listed().empty() ? views_of_unproven(proof) : views_of_listed(proof)) {
      queries_.leave(view.slot);
      const auto steps = [](double r) { return static_cast<std::int64_t>(std::ceil(r * (1.0 + 1e-9))) + 1; };
      growth_.unproven.push_back(
          {tree_.id(view.slot), tree_.position(view.slot), steps(view.reach), view.most > 0.0 ? steps(view.most) : 0});
    }
    std::sort(growth_.unproven.begin(), growth_.unproven.end(),
              [](const UnprovenQuery& a, const UnprovenQuery& b) { return a.id < b.id; });
  }

  /// How far a query must see that does not see enough, steps.
  struct View {
    std::uint32_t slot = 0;
    double reach = 0.0;
    double most = 0.0;  ///< No later reach is greater; 0: not known.
  };

  std::vector<View> views_of_unproven(const SupportProof& proof) const {
    const std::vector<std::uint32_t> slots = proof.unproven(queries_.are_queries(), covered_);
    const SupportProof::Depth in_tile = proof.depth_in(covered_);
    std::vector<View> views(slots.size());
    for_each_of(slots.size(), [&](std::size_t i) {
      views[i] = {slots[i], proof.reach(slots[i], in_tile), 0.0};
      if (const auto bound = proof.bound(slots[i])) {
        views[i].reach = std::max(views[i].reach, bound->first);
        views[i].most = std::max(views[i].reach, kRoundMore * bound->most);
      }
    });
    return views;
  }
  std::vector<View> views_of_listed(const SupportProof& proof) const {
    const auto listed = queries_.listed();
    std::vector<View> views(listed.size());
    for_each_of(listed.size(), [&](std::size_t i) {
      const auto [slot, reach] = listed[i];
      views[i] = {slot, proof.reach(slot, proof.depth_around(slot, static_cast<double>(reach))), 0.0};
    });
    std::erase_if(views, [](const View& view) { return view.reach == 0.0; });
    return views;
  }
  template <class Use>
  static void for_each_of(std::size_t count, const Use& use) {
    constexpr std::size_t kGrain = 64;
    parallel_for_chunks(count, kGrain, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) use(i);
    });
  }

  void write_frontier(const TileComponents& components, const FrontierSink& sink) const {
    constexpr std::size_t kBlockWords = 1 << 16;
    const std::size_t stride = parameters_.most_neighbours();
    std::vector<std::uint32_t> words;
    queries_.for_each_query([&](std::uint32_t slot) {
      if (components.all_around(slot, parameters_.least_component())) return;
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
  QueryRings queries_;
  PageVector<std::uint8_t> intensities_;  ///< Per slot.
  Likeness likeness_;
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
  // Tree 27, shapes, counts, states and reaches 23, flags and intensities 9, sets and components 8; neighbours, as of
  // points that fill space (of those on surfaces 2.2). Members take the room of the shapes.
  constexpr double kNeighbourBytes = 2.6;
  const double k = static_cast<double>(parameters.most_neighbours());
  return 27.0 + 23.0 + 9.0 + 8.0 + kNeighbourBytes * k;
}
const double kGrowthBytesPerThread = 3.0 * 1024 * 1024;

}  // namespace arris
