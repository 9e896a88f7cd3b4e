#pragma once
/// @file What the laws of the methods have in common: clouds cut, moved and put in another order.

#include <rapidcheck.h>

#include <map>
#include <ostream>
#include <span>
#include <vector>

#include "core/tile_points.h"
#include "features/contour/tile_contours.h"

namespace arris {

void PrintTo(const ContourRecord& record, std::ostream* out);

namespace test {

/// Uniform in [low, end), whatever the size that RapidCheck is at.
template <class T>
T any(T low, T end) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange<T>(low, end));
}

/// Fails the property if records or the number of isolated points differ.
void expect_equal(const TileContours& a, const TileContours& b);

/// The same points with their entries in another order.
TilePoints reordered(const TilePoints& tile, std::uint64_t seed);

/// The positions moved by whole steps, up to the very ends of int32.
LatticePoints anywhere(std::span<const LatticePoint> positions);

/// The points of `tile` inside `core` expanded by `halo`, with what belongs to them.
TilePoints part_of(const TilePoints& tile, const LatticeBox& core, std::int64_t halo);
/// The points that rerunning a query needs: exactly the reach that it asks for.
TilePoints part_of(const TilePoints& tile, const UnprovenQuery& query);

void merge(std::map<std::uint64_t, ContourRecord>& into, const ContourRecords& records);

}  // namespace test
}  // namespace arris
