#include "pipeline/tile_stage.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>

#include "core/at_work.h"
#include "core/file_descriptor.h"
#include "core/pages.h"
#include "core/parallel.h"
#include "core/process_memory.h"
#include "pipeline/analysis_turns.h"
#include "pipeline/run_support.h"
#include "pipeline/tile_retirement.h"
#include "tiling/partition.h"
#include "tiling/tile_store.h"

namespace arris::pipeline {
namespace {

constexpr std::size_t kTilesPerTrim = 16;

/// Progress of tiles that finish during the partition is held back until its own phase begins.
class TileProgress {
 public:
  explicit TileProgress(ProgressSink& sink) : sink_(sink) {}
  void done(std::uint64_t points) {
    const std::lock_guard lock(mutex_);
    if (started_) {
      sink_.advance(points);
    } else {
      held_back_ += points;
    }
  }
  void start(std::uint64_t total) {
    const std::lock_guard lock(mutex_);
    started_ = true;
    sink_.phase("contours", total);
    sink_.advance(held_back_);
  }

 private:
  ProgressSink& sink_;
  std::mutex mutex_;
  bool started_ = false;
  std::uint64_t held_back_ = 0;
};

/// Takes tiles out of the store when they are done with, and looks at the folder now and then.
class DiskKeeper {
 public:
  DiskKeeper(const TileJob& job, const std::filesystem::path& folder, tiling::TileStore& store)
      : folder_(folder),
        store_(store),
        retirement_(job.tiles, job.farthest_steps, job.asks_again),
        tiles_per_look_(1 + job.tiles.tiles.size() / kLooks) {}

  void analysed(std::size_t tile, std::span<const UnprovenQuery> unproven) {
    const std::lock_guard lock(mutex_);
    if (++analysed_ % tiles_per_look_ == 0) look();
    for (const std::size_t gone : retirement_.analysed(tile, unproven)) store_.remove(gone);
  }
  /// All points are routed.
  void routed() {
    const std::lock_guard lock(mutex_);
    look();
  }
  std::uint64_t peak_bytes() const { return peak_bytes_; }

 private:
  static constexpr std::size_t kLooks = 64;
  void look() { peak_bytes_ = std::max(peak_bytes_, folder_bytes(folder_)); }

  std::mutex mutex_;
  const std::filesystem::path& folder_;
  tiling::TileStore& store_;
  TileRetirement retirement_;
  std::size_t tiles_per_look_;
  std::size_t analysed_ = 0;
  std::uint64_t peak_bytes_ = 0;
};

}  // namespace

void write_queries(const std::filesystem::path& path, const std::vector<UnprovenQuery>& queries) {
  const FileDescriptor file = FileDescriptor::open(path, O_WRONLY | O_CREAT | O_TRUNC);
  file.write_all(std::as_bytes(std::span(queries)));
}

std::vector<UnprovenQuery> read_queries(const std::filesystem::path& path) {
  const FileDescriptor file = FileDescriptor::open(path, O_RDONLY);
  std::vector<UnprovenQuery> queries(file.size_bytes() / sizeof(UnprovenQuery));
  file.read_some(std::as_writable_bytes(std::span(queries)));
  return queries;
}

TileStageResult run_tile_stage(io::InputSet& inputs, const TileJob& job, const TileAnalysis& analysis,
                               const std::filesystem::path& folder, tiling::TileStore& store, MemoryBudget& budget,
                               ProgressSink& progress, const CancelToken& cancel) {
  TileStageResult stage;
  stage.unproven.assign(job.tiles.tiles.size(), 0);
  std::atomic<std::uint64_t> isolated{0};
  std::atomic<std::size_t> analysed{0};
  TileProgress tile_progress(progress);
  DiskKeeper disk(job, folder, store);
  // While it is built a tile takes less than it has reserved: the next analysis may have the pages of the one before.
  // What is spare when one ends is also that of the others in flight, which they take again.
  const std::uint64_t largest = job.tiles.largest_covered_points;
  const std::uint64_t spare_bytes =
      static_cast<std::uint64_t>(job.memory.tile_workers) * job.memory.tile_bytes(largest) -
      tiling::build_bytes(largest);

  AnalysisTurns turns(job.analyses_at_once);
  const auto build = [&](std::size_t tile) {
    const AtWork at_work;
    std::optional<OwnThreadLoops> alone;
    if (job.analyses_at_once < job.memory.tile_workers) alone.emplace();  // Analyses have the threads.
    TilePoints points = store.build(tile);
    points.covered = points.covered.unlimited_beyond(job.survey.bounds);
    return points;
  };
  const auto analyse = [&](std::size_t tile) {
    cancel.check();
    const tiling::PlannedTile& planned = job.tiles.tiles[tile];
    const MemoryBudget::Reservation bytes = budget.reserve(job.memory.tile_bytes(planned.covered_points));
    TileOutcome outcome;
    {
      const TilePoints points = build(tile);
      AnalysisTurns::Turn turn(turns);
      cancel.check();
      outcome = analysis(points, std::nullopt, [&turn] { turn.end(); });
    }
    if (!outcome.unproven.empty()) {
      write_queries(folder / fmt::format("{}.queries", tile), outcome.unproven);
      stage.unproven[tile] = outcome.unproven.size();
    }
    disk.analysed(tile, outcome.unproven);
    isolated += outcome.isolated;
    trim_spare_pages(spare_bytes);
    // What planning has left goes with the first; after every tile the heap would be taken from the system anew.
    if (analysed++ % kTilesPerTrim == 0) trim_heap();
    tile_progress.done(planned.core_points);
  };

  BackgroundTasks workers(job.memory.tile_workers);
  const auto closed = [&](std::size_t tile) {
    if (workers.failed()) workers.wait();  // Rethrows.
    workers.run([&, tile] { analyse(tile); });
  };
  tiling::partition_points(inputs, job.survey, job.tiles, {folder, job.memory.spool_buffer_bytes}, closed, progress,
                           cancel);
  disk.routed();
  tile_progress.start(job.survey.points());
  workers.wait();
  trim_heap();  // Who looks farther takes the spare pages.
  stage.isolated = isolated;
  stage.peak_temp_bytes = disk.peak_bytes();
  return stage;
}

}  // namespace arris::pipeline
