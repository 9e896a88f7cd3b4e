// Region growing: the components of all tiles together against the paper's queue, and against one tile.

#include "merge/segment_growth.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <deque>
#include <map>
#include <set>

#include "features/neighbourhood/point_tree.h"
#include "features/segment/likeness.h"
#include "features/segment/tile_growth.h"
#include "features/segment/tile_neighbourhoods.h"
#include "random_clouds.h"
#include "tile_laws.h"

namespace arris {
namespace {

using test::any;

const Lattice kMillimetres{0.001, {0.0, 0.0, 0.0}};

struct Grown : TileGrowth {
  std::vector<std::uint32_t> frontier;  ///< The words of all records.
};

struct Cloud {
  TilePoints tile;
  SegmentParameters parameters;
  std::uint64_t end_id = 0;

  /// Depends on the id only, in a few steps.
  std::vector<std::uint8_t> intensities(const TilePoints& part) const {
    std::vector<std::uint8_t> values;
    for (const std::uint64_t id : part.ids) values.push_back(static_cast<std::uint8_t>(id % 3 * 8));
    return values;
  }
  Grown grow(const TilePoints& part, std::optional<std::span<const PlacedQuery>> queries = std::nullopt) const {
    std::vector<std::uint32_t> frontier;
    const auto keep = [&](std::span<const std::uint32_t> records) {
      frontier.insert(frontier.end(), records.begin(), records.end());
    };
    return {grow_tile(part, intensities(part), kMillimetres, parameters, keep, queries), std::move(frontier)};
  }
  merge::PointLabels labels(const TileGrowth& growth) const {
    merge::SegmentGrowth all(end_id, parameters.min_points);
    all.add(growth);
    return all.finish().labels;
  }
};

Cloud any_cloud(std::size_t points) {
  Cloud cloud;
  const auto shape = static_cast<test::Shape>(any(0, static_cast<int>(test::Shape::kLast) + 1));
  RC_CLASSIFY(true, test::name(shape));
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const double extent = *rc::gen::element(60.0, 1000.0, 30000.0);
  cloud.tile = test::tile_of(test::random_positions(shape, points, extent, seed), seed);
  for (const std::uint64_t id : cloud.tile.ids) cloud.end_id = std::max(cloud.end_id, id + 1);
  for (const auto& [id, entry] : cloud.tile.duplicates) cloud.end_id = std::max(cloud.end_id, id + 1);
  cloud.parameters.max_radius = 0.001 * extent * *rc::gen::element(0.05, 0.3, 2.0);
  cloud.parameters.neighbours = static_cast<std::size_t>(any(3, 14));
  if (any(0, 2) == 0) {
    cloud.parameters.neighbours.reset();
    cloud.parameters.noise = 0.001 * extent * *rc::gen::element(0.003, 0.01, 0.03);
    cloud.parameters.most_by_noise = *rc::gen::elementOf(kNeighbourLevels);
  }
  cloud.parameters.angle_deg = *rc::gen::element(3.0, 7.2, 25.0);
  cloud.parameters.curvature = *rc::gen::element(0.2, 0.02);
  cloud.parameters.min_points = static_cast<std::uint32_t>(any(1, 25));
  cloud.parameters.published = any(0, 2) == 0;
  cloud.parameters.intensity = any(0, 2) == 0;
  if (any(0, 4) == 0) cloud.parameters.radius = 0.1 * cloud.parameters.max_radius;
  return cloud;
}

/// The paper's queue, literally, on symmetric neighbours. Regions by entry, numbered from 1; every growing point is in
/// one, and so is every other point that a queue came upon.
std::vector<std::uint32_t> grow_by_queue(const Cloud& cloud) {
  const TilePoints& tile = cloud.tile;
  const std::size_t n = tile.positions.size();
  const PointTree tree(tile.positions, tile.ids);
  TileNeighbourhoods points(tree, kMillimetres, cloud.parameters);
  points.compute(std::vector<std::uint8_t>(n, 1));
  std::vector<std::uint8_t> intensities(n);
  const std::vector<std::uint8_t> of_entry = cloud.intensities(tile);
  for (std::size_t slot = 0; slot < n; ++slot) intensities[slot] = of_entry[tree.entry(slot)];
  const std::span<const std::uint8_t> used =
      cloud.parameters.intensity ? std::span<const std::uint8_t>(intensities) : std::span<const std::uint8_t>();
  const Likeness likeness(points, used, cloud.parameters);

  std::vector<std::set<std::uint32_t>> neighbours(n);
  std::vector<std::uint32_t> seeds;
  for (std::uint32_t slot = 0; slot < n; ++slot) {
    if (points.state(slot) != ShapeState::kShaped) continue;
    seeds.push_back(slot);
    for (const std::uint32_t other : points.neighbours(slot)) {
      if (points.state(other) != ShapeState::kShaped) continue;
      neighbours[slot].insert(other);
      neighbours[other].insert(slot);
    }
  }
  const auto grows = [&](std::uint32_t slot) {
    return points.shape(slot).variation < static_cast<float>(cloud.parameters.curvature);
  };
  std::sort(seeds.begin(), seeds.end(), [&](std::uint32_t a, std::uint32_t b) {
    const float va = points.shape(a).variation, vb = points.shape(b).variation;
    return va != vb ? va < vb : tree.id(a) < tree.id(b);
  });
  std::vector<std::uint32_t> region(n);  // By slot.
  std::uint32_t regions = 0;
  for (const std::uint32_t seed : seeds) {
    if (region[seed] != 0 || !grows(seed)) continue;
    region[seed] = ++regions;
    for (std::deque<std::uint32_t> queue{seed}; !queue.empty(); queue.pop_front()) {
      const std::uint32_t at = queue.front();
      for (const std::uint32_t other : neighbours[at]) {
        if (region[other] != 0 || !likeness.alike(at, other)) continue;
        region[other] = regions;
        if (grows(other)) queue.push_back(other);
      }
    }
  }
  std::vector<std::uint32_t> of_entries(n);
  for (std::size_t slot = 0; slot < n; ++slot) of_entries[tree.entry(slot)] = region[slot];
  return of_entries;
}

// What cannot grow joins whichever region comes first in the paper, so there only that it joins one is compared. A
// growing point without links is a region of one for the queue, and no component.
RC_GTEST_PROP(SegmentGrowth, AsPublished_IsWhatTheQueueGives, ()) {
  Cloud cloud = any_cloud(300);
  cloud.parameters.published = true;
  cloud.parameters.min_points = 1;
  const merge::PointLabels labels = cloud.labels(cloud.grow(cloud.tile));
  const std::vector<std::uint32_t> regions = grow_by_queue(cloud);
  const TileGrowth growth = cloud.grow(cloud.tile);
  std::set<std::uint64_t> growing;
  for (const TileGrowth::Member& member : growth.members) growing.insert(member.id);
  std::map<std::uint32_t, std::uint32_t> ours_of, theirs_of;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const std::uint64_t id = cloud.tile.ids[i];
    const std::uint32_t ours = labels[id], theirs = regions[i];
    if (growing.count(id) == 0 && theirs != 0 && ours == 0) {
      RC_ASSERT(std::count(regions.begin(), regions.end(), theirs) == 1);
      continue;
    }
    RC_ASSERT((ours == 0) == (theirs == 0));
    if (ours == 0 || growing.count(id) == 0) continue;
    RC_ASSERT(ours_of.emplace(theirs, ours).first->second == ours);
    RC_ASSERT(theirs_of.emplace(ours, theirs).first->second == theirs);
  }
}

RC_GTEST_PROP(SegmentGrowth, OrderOfEntriesAndPlaceDoNotMatter, ()) {
  const Cloud cloud = any_cloud(400);
  const merge::PointLabels expected = cloud.labels(cloud.grow(cloud.tile));
  RC_ASSERT(cloud.labels(cloud.grow(test::reordered(cloud.tile, *rc::gen::arbitrary<std::uint64_t>()))) == expected);
  TilePoints moved = cloud.tile;
  moved.positions = test::anywhere(moved.positions);
  RC_ASSERT(cloud.labels(cloud.grow(moved)) == expected);
}

struct AllTiles {
  merge::GrownSegments grown;
  std::map<std::uint64_t, std::vector<std::uint32_t>> frontier;  ///< By id.
  std::uint64_t isolated = 0;
};

void add(const Grown& grown, const Cloud& cloud, merge::SegmentGrowth& growth, AllTiles& all) {
  growth.add(grown);
  all.isolated += grown.isolated;
  const std::size_t stride = 4 + cloud.parameters.most_neighbours();
  for (std::size_t at = 0; at < grown.frontier.size(); at += stride) {
    const auto record = grown.frontier.begin() + static_cast<std::ptrdiff_t>(at);
    RC_ASSERT(
        all.frontier.emplace(*record, std::vector<std::uint32_t>(record, record + static_cast<std::ptrdiff_t>(stride)))
            .second);
  }
}

/// Cut at planes across x and y, each part with a halo; what stays unproven is asked again with what it needs.
AllTiles in_parts(const Cloud& cloud, std::int64_t halo) {
  LatticeBox box;
  for (const LatticePoint& p : cloud.tile.positions) box.include(p);
  merge::SegmentGrowth growth(cloud.end_id, cloud.parameters.min_points);
  AllTiles all;
  const std::int64_t cut_x = any(box.min[0], box.max[0] + 1), cut_y = any(box.min[1], box.max[1] + 1);
  for (int part = 0; part < 4; ++part) {
    LatticeBox core = test::everything();
    (part % 2 == 0 ? core.max[0] : core.min[0]) = cut_x;
    (part / 2 == 0 ? core.max[1] : core.min[1]) = cut_y;
    const Grown grown = cloud.grow(test::part_of(cloud.tile, core, halo));
    add(grown, cloud, growth, all);
    for (UnprovenQuery query : grown.unproven) {
      const std::int64_t most = query.most_reach_steps;
      for (;;) {
        RC_ASSERT(most == 0 || query.reach_steps <= most);
        const TilePoints points = test::part_of(cloud.tile, query);
        const auto entry = std::find(points.ids.begin(), points.ids.end(), query.id) - points.ids.begin();
        const PlacedQuery queries[] = {{static_cast<std::uint32_t>(entry), query.reach_steps}};
        const Grown again = cloud.grow(points, queries);
        add(again, cloud, growth, all);
        if (again.unproven.empty()) break;
        RC_ASSERT(again.unproven[0].reach_steps > query.reach_steps);
        query = again.unproven[0];
      }
    }
  }
  all.grown = growth.finish();
  return all;
}

RC_GTEST_PROP(SegmentGrowth, HoweverTheCloudIsCut_TheSegmentsAreTheSame, ()) {
  const Cloud cloud = any_cloud(400);
  merge::SegmentGrowth growth(cloud.end_id, cloud.parameters.min_points);
  AllTiles whole;
  add(cloud.grow(cloud.tile), cloud, growth, whole);
  whole.grown = growth.finish();
  const AllTiles parts = in_parts(cloud, any(0, 400));
  RC_CLASSIFY(whole.grown.discs.size() > 1, "several segments");
  RC_ASSERT(parts.grown.labels == whole.grown.labels);
  RC_ASSERT(parts.grown.discs == whole.grown.discs);
  RC_ASSERT(parts.isolated == whole.isolated);
  // The frontier may hold more where tiles met, but nothing may be missing from it.
  for (const auto& [id, record] : whole.frontier) {
    const auto found = parts.frontier.find(id);
    RC_ASSERT(found != parts.frontier.end());
    RC_ASSERT(found->second == record);
  }
}

TileGrowth tile_with(std::vector<std::uint32_t> sizes, PageVector<TileGrowth::Member> members,
                     std::vector<TileGrowth::Touched> touched = {}, std::vector<TileGrowth::Offer> offers = {}) {
  TileGrowth tile;
  tile.discs.assign(sizes.size(), 10);
  tile.sizes = std::move(sizes);
  tile.members = std::move(members);
  tile.touched = std::move(touched);
  tile.offers = std::move(offers);
  return tile;
}

TEST(SegmentGrowthMerge, ComponentsThatTouch_AreOneSegmentNumberedByItsSmallestId) {
  merge::SegmentGrowth growth(10, 2);
  growth.add(tile_with({2, 2}, {{8, 1}, {9, 1}, {3, 2}, {4, 2}}));
  growth.add(tile_with({2}, {{0, 1}, {1, 1}}, {{8, 1}}));
  const merge::GrownSegments grown = growth.finish();
  EXPECT_EQ(grown.labels, (merge::PointLabels{1, 1, 0, 2, 2, 0, 0, 0, 1, 1}));
  EXPECT_EQ(grown.discs, (std::vector<std::uint64_t>{20, 10}));
}

TEST(SegmentGrowthMerge, PointWithoutLinksOfItsOwn_JoinsAndCounts) {
  merge::SegmentGrowth growth(5, 3);
  growth.add(tile_with({2}, {{1, 1}, {2, 1}}, {{4, 1, 7}}));
  const merge::GrownSegments grown = growth.finish();
  EXPECT_EQ(grown.labels, (merge::PointLabels{0, 1, 1, 0, 1}));
  EXPECT_EQ(grown.discs, (std::vector<std::uint64_t>{17}));
}

TEST(SegmentGrowthMerge, Offers_MostParallelWinsThenTheSmallestId) {
  merge::SegmentGrowth growth(8, 2);
  growth.add(tile_with({2, 2}, {{0, 1}, {1, 1}, {2, 2}, {3, 2}}, {},
                       {{5, 0, 0.995F, 1}, {5, 2, 0.999F, 2}, {6, 3, 0.999F, 2}, {6, 1, 0.999F, 1}}));
  EXPECT_EQ(growth.finish().labels, (merge::PointLabels{1, 1, 2, 2, 0, 2, 1, 0}));
}

TEST(SegmentGrowthMerge, SmallSegments_AreNone) {
  merge::SegmentGrowth growth(6, 3);
  growth.add(tile_with({2, 3}, {{0, 1}, {1, 1}, {2, 2}, {3, 2}, {4, 2}}));
  EXPECT_EQ(growth.finish().labels, (merge::PointLabels{0, 0, 1, 1, 1, 0}));
}

TEST(SegmentGrowthDegenerate, FewOrFlatOrCoincidentPoints_HaveADefinedResult) {
  Cloud cloud;
  cloud.parameters.max_radius = 10.0;
  cloud.end_id = 3000;
  EXPECT_TRUE(cloud.grow(TilePoints{}).members.empty());
  cloud.tile = test::tile_of({{0, 0, 0}}, 1);
  EXPECT_EQ(cloud.grow(cloud.tile).isolated, 1U);
  cloud.tile = test::tile_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}, 1);
  EXPECT_EQ(cloud.grow(cloud.tile).isolated, 5U);  // On a line.
  cloud.tile = test::tile_of(std::vector<LatticePoint>(100, LatticePoint{7, 7, 7}), 1);
  const TileGrowth same = cloud.grow(cloud.tile);
  EXPECT_EQ(same.isolated, 1U);
  EXPECT_TRUE(same.members.empty());
}

}  // namespace
}  // namespace arris
