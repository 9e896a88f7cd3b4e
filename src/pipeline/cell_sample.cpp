#include "pipeline/cell_sample.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "tiling/mapped_pass.h"

namespace arris::pipeline {
namespace {

constexpr std::size_t kGrain = 2 * 1024;

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

struct DrawnPoint {
  LatticePoint place;
  std::size_t index;
};

/// Of the points [begin, end) of a batch.
void find_drawn(const CellSample& sample, const tiling::MappedPoints& points, std::size_t begin, std::size_t end,
                std::vector<DrawnPoint>& drawn) {
  drawn.clear();
  LatticePoint last;
  bool known = false, draws = false;
  for (std::size_t i = begin; i < end; ++i) {
    if (points.outcome[i] != tiling::Mapped::kOk) continue;
    const LatticePoint place = sample.place_of(points.positions[i]);
    if (!known || place != last) {
      draws = sample.draws(place);
      last = place;
      known = true;
    }
    if (draws) drawn.push_back({place, i});
  }
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

LatticeBox CellSample::box_of(const LatticePoint& place) const {
  LatticeBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = (std::int64_t{place[axis]} << shift_) - offset();
    box.max[axis] = box.min[axis] + (std::int64_t{1} << shift_);
  }
  return box;
}

bool CellSample::draws(const LatticePoint& place) const {
  return (hash_of(place.x, place.y, place.z) >> 32) <= limit_;
}

void CellSample::add(const LatticePoint& place, const LatticePoint& p, std::uint64_t id) {
  if (last_ == nullptr || place != last_place_) {
    last_place_ = place;
    last_ = &cells_[place];
  }
  if (last_->positions.size() > kMostCellPoints) return;
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
  // Few points are drawn: all threads look for them, one adds them in order.
  std::vector<std::vector<DrawnPoint>> drawn;
  tiling::for_each_mapped_batch(
      inputs, survey.lattice, "noise", progress, cancel, [&](const tiling::MappedPoints& points) {
        drawn.resize((points.positions.size() + kGrain - 1) / kGrain);
        for (CellSample& sample : samples) {
          parallel_for_chunks(points.positions.size(), kGrain, [&](std::size_t begin, std::size_t end) {
            find_drawn(sample, points, begin, end, drawn[begin / kGrain]);
          });
          for (const std::vector<DrawnPoint>& chunk : drawn)
            for (const DrawnPoint& point : chunk)
              sample.add(point.place, points.positions[point.index], points.batch.first_id + point.index);
        }
      });
}

}  // namespace arris::pipeline
