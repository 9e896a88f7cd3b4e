#pragma once
/// @file Region growing in one tile (Yu et al.), as connected components, so that no order matters.
///
/// Two points are linked if one is among the other's neighbours, both can grow, and both are alike: the angle between
/// their normals is below the limit and their intensities differ by less than the step. A point can grow if its sigma_p
/// is below the limit (and, not as published, if a share of its neighbours are like it). Segments are the connected
/// components of all links. As published, a point that cannot grow joins the segment of the most parallel growing point
/// that it is linked with but for that (ties: the smallest id). With symmetric neighbours the components are what the
/// paper's queue gives, whatever point it begins with.
///
/// A link belongs to the tile of the point whose neighbour the other is. Support of a query: its neighbours, theirs,
/// and (not as published) those of these.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "core/pages.h"
#include "core/tile_points.h"
#include "features/contour/tile_contours.h"
#include "features/segment/segment_parameters.h"

namespace arris {

/// What a tile says of components. They are numbered 1 .. sizes.size().
struct TileGrowth {
  /// A growing point and the component it is in.
  struct Member {
    std::uint32_t id = 0;
    std::uint32_t component = 0;
  };
  /// The same of a point of another tile.
  struct Touched {
    std::uint64_t id = 0;
    std::uint32_t component = 0;
    std::uint32_t disc = 0;  ///< d^2 / m, d being the distance of the last of m neighbours, steps^2; see discs.
  };
  /// A point that cannot grow and would join this component.
  struct Offer {
    std::uint64_t id = 0;
    std::uint64_t via = 0;   ///< The growing point it would join.
    float alignment = 0.0F;  ///< |n . n'|: the greatest wins, then the smallest via.
    std::uint32_t component = 0;
  };

  PageVector<Member> members;        ///< Queries.
  std::vector<Touched> touched;      ///< Growing points that are no queries, linked with a query.
  std::vector<Offer> offers;         ///< To any points.
  std::vector<std::uint32_t> sizes;  ///< Queries in each component.
  /// Sum over the queries of each component of what Touched::disc is, rounded down and at most 2^32 - 1 each: times pi,
  /// about the component's area.
  std::vector<std::uint64_t> discs;
  std::vector<UnprovenQuery> unproven;  ///< Ascending ids; they left no trace in the rest.
  std::uint64_t isolated = 0;           ///< Queries without a normal.

  static constexpr std::uint32_t kNoId = 0xffffffffU;  ///< Ids are below.
};

/// Takes records of queries that may have a neighbour of another segment or none, (4 + k) words each: id, x, y, z, then
/// the ids of the neighbours, filled up with TileGrowth::kNoId; all queries that are in no component of
/// least_component() or more are among them. Called several times, by one thread.
using FrontierSink = std::function<void(std::span<const std::uint32_t> records)>;

/// @param intensities  0 to 255 per entry of tile.positions, or empty.
/// @param queries      entries, each with the part of space that is covered around it; without, the points of
/// tile.core,
///                     and tile.covered is.
/// Runs in parallel. The bits of the union of all tiles' results depend on points, intensities and parameters only, but
/// for the numbers of components.
TileGrowth grow_tile(const TilePoints& tile, std::span<const std::uint8_t> intensities, const Lattice& lattice,
                     const SegmentParameters& parameters, const FrontierSink& frontier,
                     std::optional<std::span<const PlacedQuery>> queries = std::nullopt);

/// The frontier of the points of tile.core whose support lies in tile.covered, of these alone. @return how many they
/// are.
std::uint64_t grow_proven(const TilePoints& tile, std::span<const std::uint8_t> intensities, const Lattice& lattice,
                          const SegmentParameters& parameters, const FrontierSink& frontier);

/// Bytes beyond the tile itself, for predictions.
double growth_bytes_per_point(const SegmentParameters& parameters);
extern const double kGrowthBytesPerThread;

}  // namespace arris
