#include "tiling/survey.h"

#include <algorithm>
#include <atomic>
#include <vector>

#include "core/stages.h"
#include "tiling/cell_level.h"
#include "tiling/lattice_choice.h"
#include "tiling/mapped_pass.h"
#include "tiling/spacing.h"

namespace arris::tiling {
namespace {

/// Points here and there, by which counting knows how coarse it will be.
constexpr std::uint64_t kSampleBatches = 64;
constexpr std::size_t kSampleBatchPoints = 1024;
constexpr int kUnknownLevel = -1;

struct SurveyBatch {
  MappedPoints points;
  SurveyTotals totals;
  CellRuns runs;
};

/// @param level  of some time before; where it is not known, the least that these points will need.
void find_cells(SurveyBatch& batch, int level) {
  const std::span<const LatticePoint> positions = batch.points.positions;
  const std::span<const Mapped> outcome = batch.points.outcome;
  batch.totals = totals_of(positions, outcome);
  if (level == kUnknownLevel) {
    for_each_mapped_run(outcome, [&](std::size_t begin, std::size_t end) {
      level = level_that_fits(positions.subspan(begin, end - begin), std::max(level, 0), kMostCellLeaves);
    });
  }
  batch.runs.clear(std::max(level, 0));
  for_each_mapped_run(
      outcome, [&](std::size_t begin, std::size_t end) { batch.runs.add(positions.subspan(begin, end - begin)); });
}

/// The finest level that may do for all points. 0 where they cannot be had here and there.
int least_level(io::InputSet& inputs, const Lattice& lattice) {
  std::vector<LatticePoint> sample;
  MappedReader reader(inputs, lattice);
  MappedPoints points;
  for (std::uint64_t i = 0; i < kSampleBatches; ++i) {
    if (!inputs.skip_to(inputs.points() / kSampleBatches * i) || !reader.read(points, kSampleBatchPoints)) return 0;
    for_each_mapped_run(points.outcome, [&](std::size_t begin, std::size_t end) {
      sample.insert(sample.end(), points.positions.begin() + static_cast<std::ptrdiff_t>(begin),
                    points.positions.begin() + static_cast<std::ptrdiff_t>(end));
    });
  }
  return level_that_fits(sample, 0, kMostCellLeaves);
}

}  // namespace

void SurveyTotals::add(const SurveyTotals& more) {
  bounds.include(more.bounds);
  points_in += more.points_in;
  dropped_nonfinite += more.dropped_nonfinite;
  dropped_out_of_range += more.dropped_out_of_range;
  dropped_excluded += more.dropped_excluded;
}

SurveyTotals totals_of(std::span<const LatticePoint> positions, std::span<const Mapped> outcome) {
  SurveyTotals totals;
  totals.points_in = positions.size();
  for_each_mapped_run(outcome, [&](std::size_t begin, std::size_t end) {
    LatticePoint low = positions[begin], high = low;
    for (const LatticePoint& p : positions.subspan(begin, end - begin)) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    totals.bounds.include(low);
    totals.bounds.include(high);
  });
  for (const Mapped mapped : outcome) {
    totals.dropped_nonfinite += mapped == Mapped::kNonFinite;
    totals.dropped_out_of_range += mapped == Mapped::kOutOfRange;
    totals.dropped_excluded += mapped == Mapped::kExcluded;
  }
  return totals;
}

void Survey::add(std::span<const LatticePoint> positions, std::span<const Mapped> outcome) {
  SurveyTotals::add(totals_of(positions, outcome));
  for_each_mapped_run(outcome,
                      [&](std::size_t begin, std::size_t end) { counts.add(positions.subspan(begin, end - begin)); });
}

void Survey::finish() {
  classes = counts.classes();
  spacing = lattice.step * estimate_spacing(counts, classes, bounds).steps;
}

Survey survey_inputs(io::InputSet& inputs, const SurveyOptions& options, ProgressSink& progress,
                     const CancelToken& cancel) {
  LatticeChoice choice(inputs.sources(), options.lattice_step);
  if (choice.needs_points()) {
    const io::ReadOptions read_options;
    io::PointBatch batch;
    progress.phase("bounds", inputs.points());
    inputs.rewind();
    while (inputs.read(batch, read_options)) {
      cancel.check();
      choice.add(batch, inputs.source_index());
      progress.advance(batch.count);
    }
  }

  Survey survey;
  const bool is_large = inputs.points() > 4 * kSampleBatches * kSampleBatchPoints;
  std::atomic<int> level = is_large ? least_level(inputs, choice.lattice()) : kUnknownLevel;
  survey.counts = CellCounts(std::max(level.load(), 0));
  progress.phase("survey", inputs.points());
  MappedReader reader(inputs, choice.lattice());
  ItemPlaces<SurveyBatch> batches;
  // Counting goes on with one batch at a time, and is all that it does: cells are found before, at the level of then.
  const auto look_at = [&](SurveyBatch& batch) {
    reader.map(batch.points);
    find_cells(batch, level);
  };
  const auto count = [&](const SurveyBatch& batch) {
    cancel.check();
    survey.SurveyTotals::add(batch.totals);
    survey.counts.add(batch.runs);
    level = survey.counts.level();
    progress.advance(batch.points.batch.count);
  };
  run_stages(batches.size(), [&](std::size_t place) { return reader.fetch(batches[place].points); },
             {{StageOrder::kAnyOrder, [&](std::size_t place) { look_at(batches[place]); }},
              {StageOrder::kInTurn, [&](std::size_t place) { count(batches[place]); }}});
  survey.lattice = choice.lattice();
  survey.finish();
  return survey;
}

}  // namespace arris::tiling
