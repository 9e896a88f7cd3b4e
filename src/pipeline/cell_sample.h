#pragma once
/// @file The points of some small parts of a scan, whole.

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/cancel.h"
#include "core/lattice.h"
#include "core/progress.h"
#include "io/point_source.h"
#include "tiling/survey.h"

namespace arris::pipeline {

/// Absolute cells drawn by a hash of their place, so that nothing depends on tiles, budget or order. Their faces lie
/// off round coordinates, where floors and walls of drawn models are: planes in a face have all their points near the
/// end of what is seen.
class CellSample {
 public:
  struct Cell {
    std::vector<LatticePoint> positions;
    std::vector<std::uint64_t> ids;
  };

  /// @param side_spacings  of a cell, rounded up to a power of two of steps. @param points  to be drawn, about.
  CellSample(const tiling::Survey& survey, double side_spacings, double points);

  /// Of the cells: their sides are 2^level steps.
  int level() const { return shift_; }
  bool draws(const LatticePoint& place) const;
  LatticePoint place_of(const LatticePoint& p) const {
    const auto place = [this](std::int32_t c) { return static_cast<std::int32_t>((c + offset()) >> shift_); };
    return {place(p.x), place(p.y), place(p.z)};
  }
  /// A point of a place that is drawn; in ascending order of ids.
  void add(const LatticePoint& place, const LatticePoint& p, std::uint64_t id);
  struct View {
    LatticeBox box;
    const Cell* points;
  };
  /// The cells in the order of their places, but for those of more than kMostCellPoints: one heap of points must not
  /// take the memory.
  std::vector<View> cells() const;

 private:
  static constexpr std::size_t kMostCellPoints = 200'000;

  std::int64_t offset() const { return (std::int64_t{1} << shift_) * 3 / 8; }
  LatticeBox box_of(const LatticePoint& place) const;

  int shift_;
  std::uint64_t limit_;
  std::map<LatticePoint, Cell> cells_;
  LatticePoint last_place_;
  Cell* last_ = nullptr;
};

/// Reads the inputs once for all of the samples.
void draw_cells(io::InputSet& inputs, const tiling::Survey& survey, std::span<CellSample> samples,
                ProgressSink& progress, const CancelToken& cancel);

}  // namespace arris::pipeline
