#include "tiling/point_grid.h"

#include "tiling/grid_backend.h"

namespace arris::tiling {

PointGrid::PointGrid(std::span<const LatticePoint> positions, std::span<const std::uint64_t> ids,
                     const std::map<std::string, std::string>& metadata)
    : stored_(grid_backend().make(positions, ids, metadata)) {}

PointGrid::~PointGrid() = default;

void PointGrid::write(std::ostream& stream) const {
  stored_->write(stream);
}

SortedPoints PointGrid::take_points() && {
  return stored_->take_points();
}

SortedPoints read_point_grid(std::istream& stream, const std::function<bool(const LatticeBox&)>& wanted) {
  return grid_backend().read(stream, wanted);
}

}  // namespace arris::tiling
