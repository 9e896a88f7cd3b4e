#pragma once
/// @file Points on the faces of a scene, row by row. Private to synth.

#include <cstdint>
#include <vector>

#include "synth/counter_random.h"
#include "synth/point_finish.h"
#include "synth/point_units.h"
#include "synth/poisson_disc.h"
#include "synth/scene_model.h"
#include "synth/surface_cells.h"

namespace arris::synth {

struct SurfaceSampling {
  Sampling sampling = Sampling::kJittered;
  double spacing = 0.0;   ///< > 0.
  double noise = 0.0;     ///< Standard deviation per axis.
  double outliers = 0.0;  ///< [0, 1).
  std::uint64_t seed = 0;
};

/// A unit is one row of cells of one face (of one layer for volumes).
class SurfaceSampler final : public PointUnits {
 public:
  /// @param model  must outlive the sampler. Throws ConfigError if the spacing asks for more than 10^15 points.
  SurfaceSampler(const SceneModel& model, const SurfaceSampling& sampling);

  std::uint64_t count() const override { return rows_; }
  std::size_t unit_points() const override { return unit_points_; }
  double expected_points() const override { return expected_points_; }
  void make(std::uint64_t begin, std::uint64_t end, std::vector<io::FreshPoint>& out) const override;

  /// The spacing at which about `points` points come out.
  static double spacing_for(const SceneModel& model, Sampling sampling, std::uint64_t points);

 private:
  struct Raster {
    std::size_t face = 0;
    std::uint64_t first_row = 0;
    std::uint64_t columns = 1, rows = 1, layers = 1;  ///< Of cells; a sphere's rows have columns of their own.
  };

  CellRow row_of(const Raster& raster, std::uint64_t index) const;
  void make_row(const Raster& raster, std::uint64_t row, std::vector<io::FreshPoint>& out) const;
  /// The candidates of a raster for Poisson-disc sampling.
  PoissonDiscRows discs_of(const Raster& raster) const;
  void make_disc_row(const Raster& raster, std::uint64_t row, PoissonDiscRows& discs,
                     std::vector<io::FreshPoint>& out) const;
  void place(const Face& face, const CellRow& row, std::uint64_t column, PointRandom random,
             std::vector<io::FreshPoint>& out) const;

  const SceneModel& model_;
  SurfaceSampling sampling_;
  Box3 bounds_;
  PointFinish finish_;
  std::vector<Raster> rasters_;
  std::uint64_t rows_ = 0;
  std::size_t unit_points_ = 1;
  double expected_points_ = 0.0;
};

}  // namespace arris::synth
