#pragma once
/// @file The k nearest neighbours of one query among candidates, in canonical order.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/pages.h"
#include "features/neighbourhood/candidate_set.h"
#include "features/neighbourhood/point_tree.h"

namespace arris {

/// Neighbours of one point in canonical order: (exact squared distance, global id). The point itself is not among them.
struct Neighbours {
  static constexpr bool kOfPacked = true;  ///< Found among candidates that are packed.

  std::size_t count = 0;
  std::vector<double> dx, dy, dz;   ///< Position minus the query's, steps, exact; padded with zeros.
  std::vector<double> d2;           ///< Squared distances, steps² (rounded above 2^53).
  std::vector<std::uint32_t> slot;  ///< In tree order.
  std::uint64_t last_d2 = 0;        ///< Exact square of the last one's distance.

  void reserve(std::size_t k) {
    for (auto* column : {&dx, &dy, &dz, &d2}) column->resize(simd::padded(k) + simd::kPadding);
    slot.resize(simd::padded(k) + simd::kPadding);
  }
  double last_d2_guess() const { return static_cast<double>(last_d2); }
};

/// What to look for. `k` neighbours, at most `max_d2` away (in T: exact), starting with those within `guess_d2`.
template <class T>
struct NearestQuery {
  T x, y, z;  ///< Relative to the candidates' origin.
  std::size_t k = 0;
  T max_d2 = 0;
  T guess_d2 = 0;
};

/// Reusable memory of select_nearest.
template <class T>
struct NearestScratch {
  PageVector<T> d2;
  PageVector<std::uint32_t> candidate;
  PageVector<std::int32_t> rank;
  PageVector<std::uint32_t> sorted;
  PageVector<T> sorted_d2;
  std::vector<std::pair<T, std::uint32_t>> pairs;
  PageVector<PackedCandidate> rows;

  void make_room(std::size_t candidates) {
    const std::size_t room = simd::padded(candidates) + simd::kPadding;
    if (d2.size() >= room) return;
    for (auto* column : {&d2, &sorted_d2}) column->resize(room);
    for (auto* column : {&candidate, &sorted}) column->resize(room);
    rank.resize(room);
    rows.resize(room);
  }
};

/// The query itself is one of the candidates, which are packed. Fills min(k, those within max_d2) neighbours; ties are
/// resolved by id. Complexity: O(candidates + s²/16), s being the number within the guess.
template <class T>
void select_nearest(const PointTree& tree, const CandidateSet<T>& candidates, const NearestQuery<T>& query,
                    NearestScratch<T>& scratch, Neighbours& found);

}  // namespace arris
