#pragma once
/// @file Pass 1: what is in the inputs and where. Nothing but points and parameters decides what is found here, so
/// everything derived from a survey may influence results.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/cancel.h"
#include "core/lattice.h"
#include "core/progress.h"
#include "io/point_source.h"
#include "tiling/cell_counts.h"
#include "tiling/lattice_mapper.h"

namespace arris::tiling {

struct SurveyOptions {
  /// > 0: the lattice step in data units. 0: the common LAS scale if all inputs agree (the finest axis if the others
  /// are whole multiples of it), otherwise 0.0001. lattice_choice.h has the laws.
  double lattice_step = 0.0;
};

/// How many points there are, and where, all in all.
struct SurveyTotals {
  LatticeBox bounds;                       ///< Of the points that take part; empty if there are none.
  std::uint64_t points_in = 0;             ///< Points read.
  std::uint64_t dropped_nonfinite = 0;     ///< NaN or infinite coordinates: they take no part and stay unlabelled.
  std::uint64_t dropped_out_of_range = 0;  ///< Finite, but not representable on the lattice.
  std::uint64_t dropped_excluded = 0;      ///< Excluded by the caller (InputSet::exclude).
  std::uint64_t points() const { return points_in - dropped_nonfinite - dropped_out_of_range - dropped_excluded; }

  void add(const SurveyTotals& more);
};

/// Of a batch of mapped points (equal lengths).
SurveyTotals totals_of(std::span<const LatticePoint> positions, std::span<const Mapped> outcome);

struct Survey : SurveyTotals {
  Lattice lattice;
  /// Typical spacing in data units: median over points of cell / sqrt(count of the cell), on the finest level at which
  /// the median count is at least 16 (coarser levels are made from finer ones). 0 for empty input; spacing.h has the
  /// degenerate cases.
  double spacing = 0.0;
  CellCounts counts;               ///< Points per absolute cell of 2^k lattice steps.
  std::vector<CellClass> classes;  ///< Of counts.

  /// Counts a batch of mapped points (equal lengths).
  void add(std::span<const LatticePoint> positions, std::span<const Mapped> outcome);
  /// Completes the survey after the last batch: sets spacing and classes.
  void finish();
};

/// Calls use(begin, end) for every maximal run [begin, end) of kOk points.
template <typename Use>
void for_each_mapped_run(std::span<const Mapped> outcome, Use&& use) {
  for (std::size_t begin = 0; begin < outcome.size();) {
    if (outcome[begin] != Mapped::kOk) {
      ++begin;
      continue;
    }
    std::size_t end = begin + 1;
    while (end < outcome.size() && outcome[end] == Mapped::kOk) ++end;
    use(begin, end);
    begin = end;
  }
}

/// Streams all inputs once; twice where the lattice depends on the points (floating point, differing scales or
/// offsets). Memory: at most ~40 MB whatever the inputs hold, twice that with more than one thread; typically 10 MB.
/// Throws Cancelled, and what reading throws.
Survey survey_inputs(io::InputSet& inputs, const SurveyOptions& options, ProgressSink& progress,
                     const CancelToken& cancel);

}  // namespace arris::tiling
