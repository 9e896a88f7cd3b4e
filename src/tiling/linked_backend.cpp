#include "tiling/grid_backend.h"

namespace arris::tiling {

const GridBackend& grid_backend() {
  return vdb_backend();
}

PointGridPreparation::PointGridPreparation() = default;
PointGridPreparation::~PointGridPreparation() = default;

std::uint64_t point_grid_bytes_to_come() {
  return 0;
}

}  // namespace arris::tiling
