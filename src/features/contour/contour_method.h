#pragma once
/// @file The methods that find contour points, behind one door.

#include <cstdint>
#include <span>
#include <string_view>

#include "core/lattice.h"
#include "core/tile_points.h"
#include "features/arris/arris_parameters.h"
#include "features/contour/tile_contours.h"
#include "features/liu/liu_parameters.h"
#include "features/supervoxel/supervoxel_parameters.h"
#include "features/zheng/zheng_method.h"

namespace arris {

/// Which method, and the parameters of all; those of the others have no effect.
struct ContourParameters {
  enum class Method : std::uint8_t { kArris, kLiu, kZheng } method = Method::kArris;
  ArrisParameters arris;
  LiuParameters liu;
  ZhengParameters zheng;
  SupervoxelParameters supervoxel;  ///< Of kZheng.

  std::string_view name() const;
  double spacing() const;
  /// R_max; kZheng: its halo, which is the support of every query.
  double max_radius() const;
  void set_max_radius(double radius);
  /// Radius that the user has fixed for all balls, 0 if none: R_max must not be smaller.
  double fixed_radius() const { return method == Method::kLiu ? liu.radius : 0.0; }
  /// False if every test is switched off: then no point is a contour point.
  bool any_test() const;
  bool by_supervoxels() const { return method == Method::kZheng; }
};

/// Throws ConfigError, naming the option, if a value of the chosen method is out of range.
void validate(const ContourParameters& parameters);

/// See extract_arris and extract_liu. Not for methods by supervoxels, which need labels: see extract_zheng.
TileContours extract_contours(const TilePoints& tile, const Lattice& lattice, const ContourParameters& parameters);
TileContours extract_contours(const TilePoints& tile, const Lattice& lattice, const ContourParameters& parameters,
                              std::span<const std::uint32_t> queries);

/// A halo, in data units, that proves nearly all queries where the spacing is at most `spacing`.
double contour_halo(const ContourParameters& parameters, double spacing);

/// Drops from a combined record what the parameters do not let pass and gives it its final score; classes 0: no
/// contour.
void finish_record(ContourRecord& record, const ContourParameters& parameters);

/// Bytes beyond the tile itself, for predictions.
double contour_bytes_per_point(const ContourParameters& parameters);
double contour_bytes_per_thread(const ContourParameters& parameters);
/// Whatever the method.
extern const double kContourBytesPerThread;

}  // namespace arris
