#pragma once
/// @file The largest gap between the azimuths of neighbours seen along the normal (Liu et al., eq. 7-11).

#include <cstddef>
#include <cstdint>
#include <vector>

#include "features/neighbourhood/nearest_select.h"
#include "features/numerics/symmetric_eigen3.h"

namespace arris {

/// Gaps this much below the threshold still reach it, so that a right angle on a grid is one whatever the rounding.
/// Degrees.
constexpr double kGapTie_deg = 1e-7;

/// How eq. 11 reads the azimuth span of a run of far neighbours.
enum class GapSpan : std::uint8_t {
  kBracket,  ///< Between the near neighbours that bracket the run.
  kInner,    ///< From the first to the last of the run.
};

struct GapQuery {
  Vector3 u, v;                ///< Orthonormal directions in the plane.
  std::size_t count = 0;       ///< k_opt: the first so many neighbours count.
  std::size_t near_count = 0;  ///< Those no farther than d_thr: a prefix, as neighbours are sorted by distance.
  double min_offset = 0.0;     ///< A neighbour whose projection is this close to the query's has no azimuth; steps.
};

/// What the two tests found. At most one of the gaps is non-zero.
struct GapResult {
  double boundary_deg = 0.0;  ///< Largest gap of all neighbours if it reaches the threshold (eq. 10).
  double weak_deg = 0.0;      ///< Otherwise the largest span of far neighbours if that does (eq. 11).
};

/// The boundary test of one query. Fewer than three azimuths are no evidence. Invariant to the signs of u and v.
class AzimuthGapTest {
 public:
  /// @param threshold_deg  alpha_thr, in (0, 360).
  AzimuthGapTest(double threshold_deg, GapSpan span);

  /// O(k), seldom O(k log k). `scratch` is reusable memory.
  struct Entry {
    double azimuth;
    bool far;
  };
  GapResult operator()(const Neighbours& neighbours, const GapQuery& query, std::vector<Entry>& scratch) const;
  /// The same without the early rejection: for tests, which require equality.
  GapResult without_rejection(const Neighbours& neighbours, const GapQuery& query, std::vector<Entry>& scratch) const;

 private:
  double threshold_deg_;
  GapSpan span_;
  int empty_bins_;  ///< A gap of the threshold leaves so many of the 64 bins in a row empty; 0: no early rejection.
};

}  // namespace arris
