#pragma once
/// @file Turns the coordinates of a batch into lattice points, the same way in every pass.

#include <array>
#include <cstdint>
#include <vector>

#include "core/lattice.h"
#include "io/point_source.h"

namespace arris::tiling {

/// What became of a point's coordinates.
enum class Mapped : std::uint8_t { kOk, kNonFinite, kOutOfRange, kExcluded };

/// For LAS sources whose scales are whole multiples of the step the mapping is integer arithmetic: exact where the
/// offset agrees with the lattice too, else the same rounding for every point. Other coordinates go to the nearest
/// lattice index, half away from zero. Immutable; safe to use from several threads.
class LatticeMapper {
 public:
  LatticeMapper(const std::vector<io::SourceInfo>& sources, const Lattice& lattice);
  /// Resizes and fills both outputs, batch.count entries each. Points that are not kOk have an unspecified position.
  void map(const io::PointBatch& batch, std::size_t source_index, std::vector<LatticePoint>& positions,
           std::vector<Mapped>& outcome) const;
  /// True if the source's stored integers are mapped by integer arithmetic.
  bool by_integers(std::size_t source_index) const { return mappings_.at(source_index).by_integers; }

 private:
  struct SourceMapping {
    bool scaled_integers = false;
    bool by_integers = false;
    std::array<std::int64_t, 3> factor{1, 1, 1};  ///< lattice = factor * stored + shift, if by_integers.
    std::array<std::int64_t, 3> shift{0, 0, 0};
    std::array<double, 3> scale{1, 1, 1};
    std::array<double, 3> offset{0, 0, 0};
  };
  void map_positions(const io::PointBatch& batch, std::size_t source_index, std::vector<LatticePoint>& positions,
                     std::vector<Mapped>& outcome) const;
  Mapped map_world(const std::array<double, 3>& world, LatticePoint& position) const;

  Lattice lattice_;
  std::vector<SourceMapping> mappings_;
};

}  // namespace arris::tiling
