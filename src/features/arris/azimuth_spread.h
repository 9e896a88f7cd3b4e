#pragma once
/// @file The widest gap between the azimuths of planar directions.

#include <cstddef>
#include <vector>

namespace arris {

/// Reusable memory.
struct AzimuthScratch {
  std::vector<double> azimuths, first, last;
};

/// Widest difference, radians, between azimuths (angle_of) that follow each other around the circle. Law: the same bits
/// as from sorted azimuths. O(n): the widest gap is at least 2 pi / n, so that bins of half that width need to know
/// their first and last azimuth only.
/// @param u, v  at least one direction, none of them 0; readable up to simd::padded(n).
double widest_azimuth_gap(const double* u, const double* v, std::size_t n, AzimuthScratch& scratch);

}  // namespace arris
