#pragma once
/// @file The directions in which a scanner measures. Private to synth.

namespace arris::synth {

/// A spherical grid about the vertical, the same for all stations.
struct ScanGrid {
  double azimuth_step_rad = 0.0;  ///< > 0.
  double elevation_step_rad = 0.0;
  double min_elevation_sin = -1.0, max_elevation_sin = 1.0;  ///< Field of view; full circles of azimuth.
  double max_range = 0.0;                                    ///< Metres.
};

}  // namespace arris::synth
