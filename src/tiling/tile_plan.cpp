#include "tiling/tile_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "core/error.h"
#include "tiling/box_counts.h"
#include "tiling/spacing.h"

namespace arris::tiling {
namespace {

/// A core of less than 1/4 of the points that fit, in a tile that does not fit.
constexpr std::uint64_t kHaloDominates = 4;
/// A tile whose halo must stay whole and whose core is less than 1/64 of what fits is not cut further: it would not
/// help.
constexpr std::uint64_t kHaloIsTooLarge = 64;

std::vector<PlanCell> list_cells(const PlanCells& plan_cells) {
  const CellCounts& counts = plan_cells.largest();
  const int level = counts.level();
  const SpacingEstimate typical = estimate_spacing(counts, counts.classes(), plan_cells.survey().bounds);
  // Cells too small to show a density are judged by the larger cells around them.
  std::optional<CellCounts> coarse;
  if (typical.level > level) coarse = counts.coarsened(typical.level);
  std::vector<PlanCell> cells;
  cells.reserve(counts.active_cells());
  plan_cells.for_each([&](const LatticeBox& box, int cell_level, std::uint64_t count) {
    const LatticePoint corner{static_cast<std::int32_t>(box.min[0]), static_cast<std::int32_t>(box.min[1]),
                              static_cast<std::int32_t>(box.min[2])};
    double spacing = typical.steps;
    if (cell_level < level) {  // A part of a crowded cell.
      const bool covered = count >= kCoveredCellPoints;
      spacing = cell_spacing_steps(covered ? cell_level : level, covered ? count : counts.count_at(corner));
    } else if (typical.level >= 0) {
      spacing = cell_spacing_steps(typical.level, coarse ? coarse->count_at(corner) : count);
    }
    cells.push_back({corner, static_cast<float>(spacing), count, cell_level});
  });
  return cells;
}

class Planner {
 public:
  Planner(const PlanCells& cells, const PlanRequest& request)
      : request_(request), step_(cells.survey().lattice.step), cells_(list_cells(cells)), counts_(cells_) {}

  TilePlan run(std::uint64_t points) {
    constexpr std::int64_t kEnd = std::int64_t{1} << 31;
    constexpr LatticeBox kWholeLattice{{-kEnd, -kEnd, -kEnd}, {kEnd, kEnd, kEnd}};
    if (!cells_.empty()) split(cells_, kWholeLattice);
    std::uint64_t covered = 0;
    for (const PlannedTile& tile : plan_.tiles) {
      covered += tile.covered_points;
      plan_.largest_covered_points = std::max(plan_.largest_covered_points, tile.covered_points);
    }
    if (points > 0) plan_.duplication = static_cast<double>(covered) / static_cast<double>(points);
    return std::move(plan_);
  }

 private:
  static LatticeBox occupied_part(std::span<const PlanCell> cells) {
    LatticeBox box;
    for (const PlanCell& cell : cells) box.include(cell.box());
    return box;
  }

  /// No midpoint cuts a cell: a box whose occupied part is as long as its longest cell holds no other.
  void split(std::span<PlanCell> cells, LatticeBox box) {
    const LatticeBox occupied = occupied_part(cells);
    std::uint64_t core_points = 0;
    for (const PlanCell& cell : cells) core_points += cell.count;
    if (core_points > request_.max_points && cells.size() > 1) {  // Whatever its halo.
      split_longest(cells, box, occupied);
      return;
    }
    PlannedTile tile = make_tile(cells, occupied, core_points);
    if (!request_.whole_halo && tile.core_points <= request_.max_points / kHaloDominates) narrow_halo(tile);
    const bool core_fits = request_.max_core_points == 0 || tile.core_points <= request_.max_core_points;
    const bool hopeless = request_.whole_halo && tile.core_points <= request_.max_points / kHaloIsTooLarge;
    if ((tile.covered_points <= request_.max_points && core_fits) || cells.size() == 1 || (hopeless && core_fits)) {
      plan_.tiles.push_back(tile);
      return;
    }
    split_longest(cells, box, occupied);
  }

  void split_longest(std::span<PlanCell> cells, LatticeBox box, const LatticeBox& occupied) {
    int axis = 0;
    for (int other = 1; other < 3; ++other) {
      if (occupied.max[other] - occupied.min[other] > occupied.max[axis] - occupied.min[axis]) axis = other;
    }
    for (;;) {
      const std::int64_t middle = box.min[axis] + (box.max[axis] - box.min[axis]) / 2;
      if (occupied.max[axis] <= middle) {
        box.max[axis] = middle;
      } else if (occupied.min[axis] >= middle) {
        box.min[axis] = middle;
      } else {
        split_at(cells, box, axis, middle);
        return;
      }
    }
  }

  /// Halves the halo, down to one step, until the tile fits.
  void narrow_halo(PlannedTile& tile) {
    std::int64_t halo = tile.core.min[0] - tile.covered.min[0];
    while (tile.covered_points > request_.max_points && halo > 1) {
      halo /= 2;
      tile.covered = tile.core.expanded(halo);
      tile.covered_points = counts_.touching(tile.covered);
    }
  }

  void split_at(std::span<PlanCell> cells, const LatticeBox& box, int axis, std::int64_t middle) {
    const auto upper_cells =
        std::ranges::partition(cells, [&](const PlanCell& cell) { return cell.corner[axis] < middle; });
    const auto lower_count = static_cast<std::size_t>(upper_cells.begin() - cells.begin());
    LatticeBox lower = box, upper = box;
    lower.max[axis] = middle;
    upper.min[axis] = middle;
    split(cells.first(lower_count), lower);
    split(cells.subspan(lower_count), upper);
  }

  PlannedTile make_tile(std::span<const PlanCell> cells, const LatticeBox& occupied, std::uint64_t core_points) {
    PlannedTile tile;
    tile.core = occupied;
    tile.core_points = core_points;
    tile.covered = tile.core.expanded(halo_steps(cells, tile.core_points));
    tile.covered_points = counts_.touching(tile.covered);
    return tile;
  }

  std::int64_t halo_steps(std::span<const PlanCell> cells, std::uint64_t points) {
    spacings_.clear();
    for (const PlanCell& cell : cells) spacings_.emplace_back(cell.spacing_steps, cell.count);
    // Selection by weight: the part that holds the quantile is halved until one value is left.
    auto target = static_cast<std::uint64_t>(std::ceil(kHaloQuantile * static_cast<double>(points)));
    auto first = spacings_.begin(), last = spacings_.end();
    while (last - first > 1) {
      const auto middle = first + (last - first) / 2;
      std::nth_element(first, middle, last);
      std::uint64_t below = 0;
      for (auto it = first; it != middle; ++it) below += it->second;
      if (below >= target) {
        last = middle;
      } else {
        target -= below;
        first = middle;
      }
    }
    const double wanted = std::min(request_.halo(step_ * static_cast<double>(first->first)), request_.max_radius);
    constexpr double kWidest = 4294967296.0;  // Wider than the lattice.
    const double steps = std::ceil(std::min(wanted / step_, kWidest));
    return steps >= 1.0 ? static_cast<std::int64_t>(steps) : 1;
  }

  const PlanRequest& request_;
  double step_;
  std::vector<PlanCell> cells_;
  BoxCounts counts_;
  std::vector<std::pair<float, std::uint64_t>> spacings_;
  TilePlan plan_;
};

}  // namespace

TilePlan plan_tiles(const PlanCells& cells, const PlanRequest& request) {
  if (request.max_points == 0) throw ConfigError("a tile must be allowed at least one point");
  if (!request.halo || !(request.max_radius > 0.0))
    throw ConfigError("the plan needs a halo and a positive maximum radius");
  return Planner(cells, request).run(cells.survey().counts.total());
}

TilePlan plan_tiles(const Survey& survey, const PlanRequest& request) {
  return plan_tiles(PlanCells(survey), request);
}

}  // namespace arris::tiling
