#include "pipeline/growth_stage.h"

#include <algorithm>
#include <vector>

#include "core/memory_budget.h"
#include "core/pages.h"
#include "core/process_memory.h"
#include "pipeline/tile_stage.h"
#include "pipeline/widen_stage.h"
#include "tiling/tile_store.h"

namespace arris::pipeline {

GrowthResult grow_segments(io::InputSet& inputs, const GrowthSetup& setup, merge::SegmentFrontier& frontier,
                           merge::DuplicatePoints& duplicates, ProgressSink& progress, const CancelToken& cancel) {
  const TileJob& job = setup.job;
  merge::SegmentGrowth growth(inputs.points(), setup.parameters.least_component());
  const TileAnalysis analysis = [&](const TilePoints& points, std::optional<std::span<const PlacedQuery>> queries,
                                    const std::function<void()>& let_others_begin) -> TileOutcome {
    PageVector<std::uint8_t> intensities(setup.intensities.empty() ? 0 : points.ids.size());
    for (std::size_t i = 0; i < intensities.size(); ++i) intensities[i] = setup.intensities[points.ids[i]];
    TileGrowth grown = grow_tile(
        points, intensities, job.survey.lattice, setup.parameters,
        [&](std::span<const std::uint32_t> records) {
          let_others_begin();  // The frontier comes last.
          frontier.append(records);
        },
        queries);
    growth.add(grown);
    if (!queries) duplicates.append(points);
    return {std::move(grown.unproven), grown.isolated};
  };

  GrowthResult result;
  {
    tiling::TileStore store(setup.folder, job.survey.lattice, job.tiles, "");
    MemoryBudget budget(job.memory.tiles_bytes);
    const TileStageResult tiles = run_tile_stage(inputs, job, analysis, setup.folder, store, budget, progress, cancel);
    result.peak_temp_bytes = std::max(tiles.peak_temp_bytes, folder_bytes(setup.folder));
    setup.watch.lap("tiles");
    const WidenResult widened = run_widen_stage(job, tiles.unproven, analysis, setup.folder, store, progress, cancel);
    result.isolated = tiles.isolated + widened.isolated;
    result.widened_queries = widened.queries;
    for (std::size_t tile = 0; tile < job.tiles.tiles.size(); ++tile) store.remove(tile);
  }
  release_free_memory();
  setup.watch.lap("widen");
  result.segments = growth.finish();
  // What has the position of another point has its segment.
  duplicates.for_each(
      [&](const merge::DuplicatePoint& point) { result.segments.labels[point.id] = result.segments.labels[point.of]; });
  // The room that tiles have left, so that the peak of the run, which is predicted, is theirs.
  frontier.keep_border(result.segments.labels, job.room_after_tiles_bytes);
  setup.watch.lap("join");
  return result;
}

}  // namespace arris::pipeline
