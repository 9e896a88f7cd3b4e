#pragma once
/// @file Terrestrial scans of a scene: every station turns through a full circle and measures a spherical grid. Private
/// to synth.

#include <cstdint>
#include <vector>

#include "synth/point_units.h"
#include "synth/ray_caster.h"
#include "synth/scan_grid.h"

namespace arris::synth {

struct ScanSettings {
  double spacing = 0.0;       ///< Angular step as the distance of neighbouring points at 10 m; 0: from `points`.
  std::uint64_t points = 0;   ///< Wanted number of points, used if spacing is 0.
  double noise = 0.0;         ///< Standard deviation along the ray.
  double outliers = 0.0;      ///< Share of returns at a random range in front of the surface.
  double mixed_pixels = 0.0;  ///< Share of the beams across a depth edge whose return is somewhere between both depths.
  double registration = 0.0;  ///< Standard deviation of the stations' position errors, per axis.
  std::uint64_t seed = 0;
};

/// A unit is one column (one azimuth) of one station, from low to high elevations.
class ScanSimulator final : public PointUnits {
 public:
  /// @param model  with stations; must outlive the simulator. Throws ConfigError for an angular step that is out of
  /// range.
  ScanSimulator(const SceneModel& model, const ScanSettings& settings);

  std::uint64_t count() const override { return columns_ * stations_.size(); }
  std::size_t unit_points() const override { return elevations_.size(); }
  double expected_points() const override;
  void make(std::uint64_t begin, std::uint64_t end, std::vector<io::FreshPoint>& out) const override;

  double spacing() const { return spacing_; }
  ScanGrid grid() const;

 private:
  struct Station {
    RayCaster caster;
    Vec3 position;    ///< Where the scanner stands.
    Vec3 registered;  ///< Where the registration says it stands.
  };
  struct Direction {
    double sin = 0.0, cos = 1.0;
  };

  double hit_share(const Station& station) const;
  /// Range seen by the lower rim of the beam if it falls on another face at another depth, else 0.
  double range_across_edge(const Station& station, const RayCaster::Column& column, std::size_t row,
                           const RayHit& hit) const;
  void make_column(std::size_t station, std::uint64_t column, RayCaster::Column& scratch,
                   std::vector<io::FreshPoint>& out) const;

  const SceneModel& model_;
  ScanSettings settings_;
  std::vector<Station> stations_;
  double spacing_ = 0.0;
  double hit_share_sum_ = 0.0;  ///< Over the stations.
  std::uint64_t columns_ = 0;   ///< Per station.
  std::vector<Direction> elevations_;
};

}  // namespace arris::synth
