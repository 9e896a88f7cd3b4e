#pragma once
/// @file Contour points of supervoxels (Zheng et al. 2018, sections 2.2 and 2.3): mutual nearest neighbours of adjacent
/// supervoxels that are not coplanar, and alpha-shape border points that no neighbour continues.

#include <cstdint>
#include <span>

#include "core/lattice.h"
#include "core/tile_points.h"
#include "features/contour/tile_contours.h"
#include "features/supervoxel/supervoxel_table.h"

namespace arris {

/// Lengths are in data units; 0 means the factor times `spacing`.
struct ZhengParameters {
  double spacing = 0.0;      ///< s, data units, > 0 when the method runs (resolved by the pipeline).
  double angle_deg = 25.0;   ///< T of section 2.2: normals further apart are not coplanar, (0, 90).
  double contact_cap = 0.0;  ///< Mutual nearest neighbours are no further apart; 0: contact_factor * s.
  double contact_factor = 3.0;
  double alpha = 0.0;  ///< Radius of the alpha shape; 0: alpha_factor * s.
  double alpha_factor = 2.0;
  double seam_distance =
      0.0;  ///< T of section 2.3: border points this near to an adjacent supervoxel are seams; 0: seam_factor * s.
  double seam_factor = 1.8;
  bool improved = false;  ///< Offset test for parallel steps, local spacing, seams healed.
  bool boundary = true;   ///< Find border points.
  bool fold = true;       ///< Find contacts.
};

/// Throws ConfigError, naming the option, if a value is out of range.
void validate(const ZhengParameters& parameters);

/// Support radius in data units: what is said of a point depends on points (and their labels) within this distance
/// only, and on the table. The tile must be covered this far around its core; every query is then complete.
double zheng_halo(const ZhengParameters& parameters);

extern const double kZhengBytesPerPoint;  ///< Beyond the tile and the labels.
extern const double kZhengBytesPerThread;

/// @param labels  supervoxel id per entry of tile.positions, 0: none.
/// Records of all contour points in the tile's core, duplicates expanded, ascending ids; `unproven` stays empty.
/// EdgeClass: kSupervoxelContact (and kFold where the normals are more than T apart) for contacts, kBoundary for border
/// points. Runs in parallel; bits depend on points, labels, table and parameters only.
TileContours extract_zheng(const TilePoints& tile, std::span<const std::uint32_t> labels, const SupervoxelTable& table,
                           const Lattice& lattice, const ZhengParameters& parameters);

}  // namespace arris
