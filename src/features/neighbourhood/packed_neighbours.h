#pragma once
/// @file Nearest neighbours each in one piece: for who takes them apart later, many points at a time.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "features/neighbourhood/distance_ranks.h"
#include "features/neighbourhood/nearest_select.h"

namespace arris {

/// What Neighbours tells of the neighbours of one point, in the same order.
struct PackedNeighbours {
  static constexpr bool kOfPacked = true;

  struct Offset {
    double x, y, z;  ///< Position minus the query's, steps, exact.
    double squared() const { return x * x + y * y + z * z; }
  };

  std::size_t count = 0;
  bool narrow = true;  ///< Which of the two is filled.
  /// The position of the query, then the neighbours, relative to some origin: differences, their squares and sums of
  /// three of those are exact. Beyond them: anything finite. All have the same room, so that they may be swapped.
  PageVector<PackedCandidate> rows;
  Neighbours wide;  ///< Where floats are not exact, or very many are within the guess.
  std::uint64_t last_d2 = 0;

  /// @param k  neighbours at most.
  void reserve(std::size_t k) {
    rows.resize(kMostRanked + simd::kPadding, {1.0F, 1.0F, 1.0F, 0});
    rows[0] = {0.0F, 0.0F, 0.0F, 0};
    most_ = k;
  }
  std::size_t most() const { return most_; }
  double last_d2_guess() const { return static_cast<double>(last_d2); }
  Offset offset(std::size_t i) const {
    if (!narrow) return {wide.dx[i], wide.dy[i], wide.dz[i]};
    const PackedCandidate &at = rows[i + 1], &query = rows[0];
    return {static_cast<double>(at.x - query.x), static_cast<double>(at.y - query.y),
            static_cast<double>(at.z - query.z)};
  }
  std::uint32_t slot(std::size_t i) const { return narrow ? rows[i + 1].slot : wide.slot[i]; }

 private:
  std::size_t most_ = 0;
};

template <class T>
void select_nearest(const PointTree& tree, const CandidateSet<T>& candidates, const NearestQuery<T>& query,
                    NearestScratch<T>& scratch, PackedNeighbours& found);

}  // namespace arris
