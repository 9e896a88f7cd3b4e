#include "tiling/lattice_mapper.h"

#include <cmath>
#include <limits>

#include "tiling/axis_range.h"
#include "tiling/lattice_choice.h"

namespace arris::tiling {
namespace {

bool fits_int32(std::int64_t value) {
  return value >= std::numeric_limits<std::int32_t>::min() && value <= std::numeric_limits<std::int32_t>::max();
}

}  // namespace

LatticeMapper::LatticeMapper(const std::vector<io::SourceInfo>& sources, const Lattice& lattice) : lattice_(lattice) {
  for (const io::SourceInfo& source : sources) {
    SourceMapping mapping;
    mapping.scaled_integers = source.scaled_integers;
    mapping.scale = source.scale;
    mapping.offset = source.offset;
    mapping.by_integers = source.scaled_integers;
    for (std::size_t axis = 0; axis < 3 && mapping.by_integers; ++axis) {
      const double shift = (source.offset[axis] - lattice.origin[axis]) / lattice.step;
      mapping.factor[axis] = whole_multiple(source.scale[axis], lattice.step);
      // factor and shift below 2^31 and 2^61: no product or sum leaves int64.
      mapping.by_integers = mapping.factor[axis] > 0 && std::abs(shift) < 0x1p61;
      mapping.shift[axis] = mapping.by_integers ? std::llround(shift) : 0;
    }
    mappings_.push_back(mapping);
  }
}

Mapped LatticeMapper::map_world(const std::array<double, 3>& world, LatticePoint& position) const {
  std::array<std::int64_t, 3> index{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(world[axis])) return Mapped::kNonFinite;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::abs(world[axis]) > kLargestCoordinate) return Mapped::kOutOfRange;
    index[axis] = lattice_.index(static_cast<int>(axis), world[axis]);
    if (!fits_int32(index[axis])) return Mapped::kOutOfRange;
  }
  position = {static_cast<std::int32_t>(index[0]), static_cast<std::int32_t>(index[1]),
              static_cast<std::int32_t>(index[2])};
  return Mapped::kOk;
}

void LatticeMapper::map(const io::PointBatch& batch, std::size_t source_index, std::vector<LatticePoint>& positions,
                        std::vector<Mapped>& outcome) const {
  map_positions(batch, source_index, positions, outcome);
  for (std::size_t i = 0; i < batch.excluded.size(); ++i) {
    if (batch.excluded[i] != 0) outcome[i] = Mapped::kExcluded;
  }
}

void LatticeMapper::map_positions(const io::PointBatch& batch, std::size_t source_index,
                                  std::vector<LatticePoint>& positions, std::vector<Mapped>& outcome) const {
  const SourceMapping& m = mappings_.at(source_index);
  positions.resize(batch.count);
  outcome.assign(batch.count, Mapped::kOk);
  if (!m.scaled_integers) {
    for (std::size_t i = 0; i < batch.count; ++i) {
      outcome[i] = map_world({batch.x[i], batch.y[i], batch.z[i]}, positions[i]);
    }
    return;
  }
  if (!m.by_integers) {
    for (std::size_t i = 0; i < batch.count; ++i) {
      outcome[i] = map_world({m.offset[0] + m.scale[0] * batch.ix[i], m.offset[1] + m.scale[1] * batch.iy[i],
                              m.offset[2] + m.scale[2] * batch.iz[i]},
                             positions[i]);
    }
    return;
  }
  for (std::size_t i = 0; i < batch.count; ++i) {
    const std::int64_t x = m.factor[0] * batch.ix[i] + m.shift[0];
    const std::int64_t y = m.factor[1] * batch.iy[i] + m.shift[1];
    const std::int64_t z = m.factor[2] * batch.iz[i] + m.shift[2];
    positions[i] = {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), static_cast<std::int32_t>(z)};
    if (!fits_int32(x) || !fits_int32(y) || !fits_int32(z)) outcome[i] = Mapped::kOutOfRange;
  }
}

}  // namespace arris::tiling
