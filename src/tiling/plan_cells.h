#pragma once
/// @file The cells that tiles are made of: those of a survey, but neither too many nor too crowded.

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/cancel.h"
#include "core/lattice.h"
#include "core/progress.h"
#include "io/point_source.h"
#include "tiling/cell_counts.h"
#include "tiling/survey.h"

namespace arris::tiling {

/// A survey has cells of one size, which suits the scan as a whole. Solid clouds fill so many that a plan takes more
/// memory than tiles: they are planned with larger ones. Most points of a scan may lie in a few cells: those are
/// counted again in smaller ones. What is crowded depends on the budget, so no result may be derived from it.
///
/// Memory: as a survey, per refinement. The survey must outlive it.
class PlanCells {
 public:
  /// Adds points, each as often as `times` says.
  using Add = std::function<void(std::span<const LatticePoint> points, std::uint64_t times)>;

  /// @param most_points  of a cell that is not crowded; raised where more cells would be crowded than can be refined.
  /// @param least_level  Of the smallest cells.
  explicit PlanCells(const Survey& survey, std::uint64_t most_points = std::numeric_limits<std::uint64_t>::max(),
                     int least_level = 0);

  const Survey& survey() const { return survey_; }
  /// The cells without refinement.
  const CellCounts& largest() const { return coarse_ ? *coarse_ : survey_.counts; }

  /// Counts the points of the crowded among the smallest cells in cells at least eight times smaller (or of
  /// least_level). False, without a pass, if none are crowded or they are of that level.
  /// @param pass  adds all that the survey counted.
  bool refine(const std::function<void(const Add& add)>& pass);
  /// The same with a pass over the inputs. Throws Cancelled, and what reading throws.
  bool refine(io::InputSet& inputs, ProgressSink& progress, const CancelToken& cancel);
  /// Calls visit(cell box, level, count) for all non-empty cells, the smaller in place of the crowded. They are
  /// disjoint.
  void for_each(const std::function<void(const LatticeBox& cell, int level, std::uint64_t count)>& visit) const;

 private:
  const CellCounts& smallest() const { return finer_.empty() ? largest() : finer_.back(); }

  const Survey& survey_;
  std::uint64_t most_points_;
  int least_level_;
  std::optional<CellCounts> coarse_;
  std::vector<CellCounts> finer_;  ///< Each of the crowded cells of the one before, the first of largest().
};

}  // namespace arris::tiling
