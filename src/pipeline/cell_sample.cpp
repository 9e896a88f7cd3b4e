#include "pipeline/cell_sample.h"

#include <algorithm>
#include <cmath>

#include "tiling/mapped_pass.h"

namespace arris::pipeline {
namespace {

/// splitmix64 of the cell's place.
std::uint64_t hash_of(std::int64_t x, std::int64_t y, std::int64_t z) {
  std::uint64_t h = 0;
  for (const std::int64_t c : {x, y, z}) {
    h += static_cast<std::uint64_t>(c) + 0x9e3779b97f4a7c15U;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9U;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebU;
    h ^= h >> 31;
  }
  return h;
}

int shift_of(const tiling::Survey& survey, double side_spacings) {
  const double side_steps = std::max(side_spacings * survey.spacing / survey.lattice.step, 8.0);
  return std::min(30, static_cast<int>(std::ceil(std::log2(side_steps))));
}

}  // namespace

CellSample::CellSample(const tiling::Survey& survey, double side_spacings, double points)
    : shift_(shift_of(survey, side_spacings)),
      limit_(static_cast<std::uint64_t>(
          std::min(1.0, points / std::max<double>(1.0, static_cast<double>(survey.points()))) * 4294967295.0)) {}

LatticePoint CellSample::place_of(const LatticePoint& p) const {
  const auto place = [this](std::int32_t c) { return static_cast<std::int32_t>((c + offset()) >> shift_); };
  return {place(p.x), place(p.y), place(p.z)};
}

LatticeBox CellSample::box_of(const LatticePoint& place) const {
  LatticeBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = (std::int64_t{place[axis]} << shift_) - offset();
    box.max[axis] = box.min[axis] + (std::int64_t{1} << shift_);
  }
  return box;
}

void CellSample::add(const LatticePoint& p, std::uint64_t id) {
  const LatticePoint place = place_of(p);
  if (place != last_place_) {
    last_place_ = place;
    const bool drawn = (hash_of(place.x, place.y, place.z) >> 32) <= limit_;
    last_ = drawn ? &cells_[place] : nullptr;
  }
  if (last_ == nullptr || last_->positions.size() > kMostCellPoints) return;
  last_->positions.push_back(p);
  last_->ids.push_back(id);
}

std::vector<CellSample::View> CellSample::cells() const {
  std::vector<View> cells;
  for (const auto& [place, cell] : cells_)
    if (cell.positions.size() <= kMostCellPoints) cells.push_back({box_of(place), &cell});
  return cells;
}

void draw_cells(io::InputSet& inputs, const tiling::Survey& survey, std::span<CellSample> samples,
                ProgressSink& progress, const CancelToken& cancel) {
  tiling::for_each_mapped_batch(inputs, survey.lattice, "noise", progress, cancel,
                                [&](const tiling::MappedPoints& points) {
                                  tiling::for_each_mapped_run(points.outcome, [&](std::size_t begin, std::size_t end) {
                                    for (CellSample& sample : samples)
                                      for (std::size_t i = begin; i < end; ++i)
                                        sample.add(points.positions[i], points.batch.first_id + i);
                                  });
                                });
}

}  // namespace arris::pipeline
