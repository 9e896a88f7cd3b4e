#pragma once
/// @file Edges of the border of the alpha shape (Edelsbrunner, Kirkpatrick and Seidel 1983), decided point by point
/// without a triangulation, and exactly.
///
/// Points are distinct positions in a plane. A directed edge p -> q is on the border if the circle of radius alpha
/// through p and q whose centre is to the right of p -> q has no point inside, and none on it but p, q and points to
/// the left of p -> q. (So triangles whose circumcircle has a radius of exactly alpha are filled.) The shape lies to
/// the left. An edge whose reverse is on the border too has no area on either side: it is singular, and left out.
///
/// Laws: (1) predicates are exact in integers: whoever asks gets the same answer, p for the edge that leaves it and q
/// for the edge that comes to it; (2) at each point as many edges leave as arrive, and they alternate around it; (3) no
/// two edges cross.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace arris {

/// Relative to a point p, in units of which 2 alpha are at most kMostAlphaUnits.
struct PlanarNeighbour {
  std::int64_t x = 0, y = 0;
  std::uint32_t index = 0;  ///< The caller's; no influence.
};

constexpr std::int64_t kMostAlphaUnits = std::int64_t{1} << 46;

class AlphaEdges {
 public:
  /// The edges that leave p. Complete if all points up to 2 alpha away are among the neighbours.
  /// @param neighbours  distinct, none at (0, 0); any order (reordered). Those farther than 2 alpha are ignored.
  /// @return their targets, in order of (distance, x, y). O(n²) at worst, less by far for most points.
  const std::vector<PlanarNeighbour>& leaving(std::vector<PlanarNeighbour>& neighbours, std::int64_t two_alpha);

 private:
  std::vector<PlanarNeighbour> found_;
};

}  // namespace arris
