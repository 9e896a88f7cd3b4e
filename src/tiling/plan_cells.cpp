#include "tiling/plan_cells.h"

#include <algorithm>
#include <utility>

#include "tiling/mapped_pass.h"

namespace arris::tiling {
namespace {

/// As many leaves as a survey has at most: so many cells, each a leaf of cells eight times smaller, never need more.
constexpr std::size_t kMostLeaves = 8192;

/// Their plan takes 90 MB.
constexpr std::size_t kMostCells = 1 << 20;

}  // namespace

PlanCells::PlanCells(const Survey& survey, std::uint64_t most_points, int least_level)
    : survey_(survey),
      most_points_(std::max<std::uint64_t>({most_points, survey.points() / kMostLeaves, 1})),
      least_level_(least_level) {
  while (largest().active_cells() > kMostCells) coarse_ = largest().coarsened(largest().level() + 1);
}

bool PlanCells::refine(const std::function<void(const Add& add)>& pass) {
  const CellCounts& coarse = smallest();
  const int level = coarse.level();
  bool any = false;
  coarse.for_each_by_leaf([&](const LatticeBox&, std::uint64_t count) { any |= count > most_points_; });
  if (!any || level <= least_level_) return false;

  CellCounts counts(least_level_, kMostLeaves);
  const auto cell_of = [level](const LatticePoint& p) {
    return LatticePoint{p.x >> level, p.y >> level, p.z >> level};
  };
  pass([&](std::span<const LatticePoint> points, std::uint64_t times) {
    for (std::size_t begin = 0; begin < points.size();) {
      const LatticePoint cell = cell_of(points[begin]);
      std::size_t end = begin + 1;
      while (end < points.size() && cell_of(points[end]) == cell) ++end;
      if (coarse.count_at(points[begin]) > most_points_) {
        const auto run = points.subspan(begin, end - begin);
        if (times == 1) {
          counts.add(run);
        } else {
          for (const LatticePoint& p : run) counts.add(p, times);
        }
      }
      begin = end;
    }
  });
  finer_.push_back(std::move(counts));
  return true;
}

bool PlanCells::refine(io::InputSet& inputs, ProgressSink& progress, const CancelToken& cancel) {
  return refine([&](const Add& add) {
    for_each_mapped_batch(inputs, survey_.lattice, "crowded cells", progress, cancel, [&](const MappedPoints& points) {
      for_each_mapped_run(points.outcome, [&](std::size_t begin, std::size_t end) {
        add(std::span(points.positions).subspan(begin, end - begin), 1);
      });
    });
  });
}

void PlanCells::for_each(
    const std::function<void(const LatticeBox& cell, int level, std::uint64_t count)>& visit) const {
  for (std::size_t i = 0; i <= finer_.size(); ++i) {
    const CellCounts& counts = i == 0 ? largest() : finer_[i - 1];
    const bool refined = i < finer_.size();
    counts.for_each_by_leaf([&](const LatticeBox& box, std::uint64_t count) {
      if (!refined || count <= most_points_) visit(box, counts.level(), count);
    });
  }
}

}  // namespace arris::tiling
