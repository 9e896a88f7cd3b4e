#include "tiling/survey.h"

#include <algorithm>

#include "tiling/lattice_choice.h"
#include "tiling/mapped_pass.h"
#include "tiling/spacing.h"

namespace arris::tiling {

void Survey::add(std::span<const LatticePoint> positions, std::span<const Mapped> outcome) {
  points_in += positions.size();
  for_each_mapped_run(outcome, [&](std::size_t begin, std::size_t end) {
    const auto run = positions.subspan(begin, end - begin);
    counts.add(run);
    LatticePoint low = run.front(), high = run.front();
    for (const LatticePoint& p : run) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    bounds.include(low);
    bounds.include(high);
  });
  for (const Mapped mapped : outcome) {
    dropped_nonfinite += mapped == Mapped::kNonFinite;
    dropped_out_of_range += mapped == Mapped::kOutOfRange;
    dropped_excluded += mapped == Mapped::kExcluded;
  }
}

void Survey::finish() {
  spacing = lattice.step * estimate_spacing(counts, bounds).steps;
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
  for_each_mapped_batch(inputs, choice.lattice(), "survey", progress, cancel,
                        [&](const MappedPoints& points) { survey.add(points.positions, points.outcome); });
  survey.lattice = choice.lattice();
  survey.finish();
  return survey;
}

}  // namespace arris::tiling
