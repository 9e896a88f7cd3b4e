#pragma once
/// @file What the stations of a scanned scene see of its surfaces, and how densely. Private to synth.
///
/// A station sees a place if it is within range and field of view, nothing stands in between, and the surface is not
/// seen under grazing incidence: there its points would be more than 12 times as far apart (in the mean, the square
/// root of the area per point) as on a surface that faces the scanner at the same range. That is a cosine of incidence
/// of 1/144, 0.4 degrees from the surface.
///
/// Spacing follows from the steps of the scan: a step in azimuth moves the ray by r cos(elevation) dphi, one in
/// elevation by r dtheta; both are projected along the ray onto the surface. The area of their parallelogram is the
/// area per point, r^2 cos(elevation) dphi dtheta / cos(incidence); its longer axis (larger singular value) is the
/// coarse spacing. Cylinders turn away within one spacing: there the cosine counts as at least sqrt(facing spacing /
/// radius), that of one spacing away from the horizon.

#include <cstdint>
#include <vector>

#include "synth/occluders.h"
#include "synth/scan_grid.h"
#include "synth/scene_model.h"

namespace arris::synth {

struct SurfacePoint {
  Vec3 position;
  Vec3 normal;  ///< Unit, to either side.
  std::uint32_t face = 0;
};

/// One bit per station.
using StationMask = std::uint32_t;

/// Metres; both 0 where no station sees.
struct LocalSpacing {
  double mean = 0.0;    ///< 1 / sqrt(points per area of all stations together).
  double coarse = 0.0;  ///< Of the station whose coarse spacing is smallest.
};

/// Immutable; safe to use from several threads, each with its own Scratch.
class ScanVisibility {
 public:
  static constexpr double kLeastCosine = 1.0 / 144.0;
  static constexpr std::size_t kMostStations = 32;

  /// Speeds up neighbouring queries, never changes an answer.
  struct Scratch {
    std::vector<std::uint32_t> hints;
  };

  /// @param model  must outlive this; at most 32 stations.
  ScanVisibility(const SceneModel& model, const ScanGrid& grid);

  std::size_t stations() const { return positions_.size(); }
  StationMask every_station() const;
  bool sees(std::size_t station, const SurfacePoint& point, Scratch& scratch) const;
  /// @param asked  stations to test.
  StationMask seen_by(const SurfacePoint& point, StationMask asked, Scratch& scratch) const;
  /// Points per area if the station sees the place.
  double density(std::size_t station, const SurfacePoint& point) const;
  /// @param seen  by these stations.
  LocalSpacing spacing(const SurfacePoint& point, StationMask seen) const;
  /// Smallest distance of points on a surface that faces its station; for choices of step only.
  double facing_spacing(const Vec3& position) const;

 private:
  struct Steps;
  Steps steps(std::size_t station, const SurfacePoint& point) const;

  const SceneModel& model_;
  ScanGrid grid_;
  Occluders occluders_;
  std::vector<Vec3> positions_;
};

}  // namespace arris::synth
