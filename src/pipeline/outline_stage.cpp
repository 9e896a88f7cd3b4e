#include "pipeline/outline_stage.h"

#include <algorithm>
#include <mutex>

#include "core/error.h"
#include "core/memory_budget.h"
#include "core/process_memory.h"
#include "features/segment_contours/segment_contours.h"
#include "pipeline/run_support.h"
#include "pipeline/tile_stage.h"
#include "tiling/tile_store.h"

namespace arris::pipeline {
namespace {

void plan(io::InputSet& inputs, TileJob& job, const OutlineSetup& setup, ProgressSink& progress,
          const CancelToken& cancel) {
  const double halo = segment_contour_halo(setup.parameters, setup.segments.planes, job.survey.lattice);
  // Labels and planes are resident by now.
  job.memory_request.kept_bytes = 0;
  job.memory_request.method = {kSegmentContourBytesPerPoint + merge::kLabelBytesPerPoint,
                               kSegmentContourBytesPerThread};
  job.memory = plan_memory(job.memory_request);
  TileNeeds needs;
  needs.halo = [halo](double) { return halo; };
  needs.max_radius = std::max(halo, job.survey.lattice.step);
  needs.whole_halo = true;
  plan_tiles_of(job, needs, inputs, setup.request, progress, cancel);
}

}  // namespace

OutlineResult outline_segments(io::InputSet& inputs, TileJob& job, const OutlineSetup& setup,
                               merge::ResultSpool& results, ProgressSink& progress, const CancelToken& cancel) {
  plan(inputs, job, setup, progress, cancel);
  std::mutex mutex;  // Guards `edges`.
  std::vector<OutlineEdge> edges;
  const TileAnalysis analysis = [&](const TilePoints& points, std::optional<std::span<const PlacedQuery>>,
                                    const std::function<void()>& let_others_begin) {
    std::vector<std::uint32_t> labels(points.ids.size());
    for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = setup.segments.labels[points.ids[i]];
    SegmentContours found =
        analyse_segment_contours(points, labels, setup.segments.planes, job.survey.lattice, setup.parameters);
    let_others_begin();
    results.append(std::move(found.records));
    const std::lock_guard lock(mutex);
    edges.insert(edges.end(), found.edges.begin(), found.edges.end());
    return TileOutcome{};
  };
  OutlineResult result;
  {
    tiling::TileStore store(setup.folder, job.survey.lattice, job.tiles, "");
    MemoryBudget budget(job.memory.tiles_bytes);
    const TileStageResult tiles = run_tile_stage(inputs, job, analysis, setup.folder, store, budget, progress, cancel);
    result.peak_temp_bytes = std::max(tiles.peak_temp_bytes, folder_bytes(setup.folder));
    for (std::size_t tile = 0; tile < job.tiles.tiles.size(); ++tile) store.remove(tile);
  }
  release_free_memory();
  if (setup.parameters.outlines)
    result.outlines = merge::link_outlines(std::move(edges), setup.segments.planes, job.survey.lattice);
  return result;
}

}  // namespace arris::pipeline
