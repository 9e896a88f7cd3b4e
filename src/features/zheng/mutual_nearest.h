#pragma once
/// @file Mutual nearest neighbours of two supervoxels (Zheng et al. 2018, eq. 3).

#include <cstdint>
#include <limits>

#include "features/neighbourhood/point_tree.h"
#include "features/planar/labelled_group.h"

namespace arris {

struct NearestPoint {
  std::size_t index = 0;                                ///< In the group; meaningful if d2 is finite.
  double d2 = std::numeric_limits<double>::infinity();  ///< Steps², exact.
};

/// The point of `part` nearest to `at` (relative to the group's origin) among those no farther than sqrt(most_d2); ties
/// by the smaller id. d2 is infinite if there is none. O(points of the part).
NearestPoint nearest_in(const PointTree& tree, const LabelledGroup& group, const LabelledPart& part, const Vector3& at,
                        double most_d2);

/// True if a point of `part` is no farther than sqrt(most_d2) from `at`. O(points of the part).
bool any_within(const LabelledGroup& group, const LabelledPart& part, const Vector3& at, double most_d2);

/// A partner is a point of another supervoxel such that each is the other's nearest in its supervoxel.
/// @param slot    a point of `own`, with every point of `own` within twice the cap of it in the group ...
/// @param other   ... and every point of `other` within the cap.
/// @param cap_d2  square of the largest distance of partners, at most 2^52.
/// @return the partner, d2 infinite if there is none. At most one: nearest neighbours are unique by the rule for ties.
NearestPoint mutual_nearest(const PointTree& tree, const LabelledGroup& group, std::uint32_t slot,
                            const LabelledPart& own, const LabelledPart& other, double cap_d2);

}  // namespace arris
