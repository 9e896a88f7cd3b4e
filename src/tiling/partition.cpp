#include "tiling/partition.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/read_ahead.h"
#include "core/text.h"
#include "tiling/mapped_pass.h"
#include "tiling/spool.h"
#include "tiling/tile_router.h"

namespace arris::tiling {
namespace {

constexpr const char* kChanged = "an input was changed while it was being read; run again when all files are complete";

/// Points and the tiles that are complete with them.
struct CountedPoints {
  MappedPoints points;
  std::vector<std::uint32_t> complete;
};

SpoolWriter::Limits spool_limits(const TilePlan& plan, const PartitionOptions& options) {
  SpoolWriter::Limits limits;
  limits.buffer_bytes = options.buffer_bytes;
  for (const PlannedTile& tile : plan.tiles)
    limits.expected_bytes += static_cast<std::uint64_t>(kSpoolBytesPerPoint * static_cast<double>(tile.covered_points));
  return limits;
}

}  // namespace

struct Partitioner::Impl {
  Impl(const CellCounts& counts, const TilePlan& plan, const PartitionOptions& options,
       std::function<void(std::size_t)> on_closed)
      : router(plan),
        remaining(counts.coarsened(counts.level())),
        open_cells(plan.tiles.size(), 0),
        spooled(options.folder, plan.tiles.size(), spool_limits(plan, options)),
        closed(std::move(on_closed)) {
    remaining.for_each_by_leaf([&](const LatticeBox& cell, std::uint64_t) {
      for (const std::uint32_t tile : touching(cell)) ++open_cells[tile];
    });
    untouched.resize(plan.tiles.size());
    for (std::size_t tile = 0; tile < untouched.size(); ++tile) untouched[tile] = open_cells[tile] == 0;
  }

  const std::vector<std::uint32_t>& touching(const LatticeBox& cell) {
    found.clear();
    router.touching(cell, found);
    return found;
  }

  void close(std::size_t tile) {
    spooled.close(tile);
    closed(tile);
  }

  TileRouter router;

  // For counting only.
  CellCounts remaining;                   // Points still to come, per cell.
  std::vector<std::uint64_t> open_cells;  // Per tile: cells that touch its covered box and still expect points.
  std::vector<std::uint32_t> found;

  SpoolWriter spooled;
  std::vector<bool> untouched;  // Tiles that no cell touches.
  std::function<void(std::size_t)> closed;
};

Partitioner::Partitioner(const CellCounts& counts, const TilePlan& plan, const PartitionOptions& options,
                         std::function<void(std::size_t tile)> closed)
    : impl_(std::make_unique<Impl>(counts, plan, options, std::move(closed))) {}
Partitioner::~Partitioner() = default;

void Partitioner::add(std::span<const LatticePoint> points, std::uint64_t first_id) {
  std::vector<std::uint32_t> complete;
  count(points, first_id, complete);
  spool(points, first_id);
  close(complete);
}

void Partitioner::count(std::span<const LatticePoint> points, std::uint64_t first_id,
                        std::vector<std::uint32_t>& complete) {
  Impl& impl = *impl_;
  const std::size_t unexpected = impl.remaining.remove(points, [&](const LatticeBox& cell) {
    for (const std::uint32_t tile : impl.touching(cell)) {
      if (--impl.open_cells[tile] == 0) complete.push_back(tile);
    }
  });
  if (unexpected > 0) {
    throw InputError(fmt::format("{} of the points from number {} on were not there in the first pass: {}", unexpected,
                                 first_id, kChanged));
  }
}

void Partitioner::spool(std::span<const LatticePoint> points, std::uint64_t first_id) {
  Impl& impl = *impl_;
  for (std::size_t begin = 0; begin < points.size();) {
    const TileRouter::Route& route = impl.router.route(points[begin]);
    std::size_t end = begin + 1;
    while (end < points.size() && route.region.contains(points[end])) ++end;
    for (const std::uint32_t tile : route.tiles) {
      impl.spooled.append(tile, points.subspan(begin, end - begin), first_id + begin);
    }
    begin = end;
  }
}

void Partitioner::close(std::span<const std::uint32_t> complete) {
  for (const std::uint32_t tile : complete) impl_->close(tile);
}

PartitionResult Partitioner::finish() {
  Impl& impl = *impl_;
  if (impl.remaining.total() > 0) {
    throw InputError(fmt::format("{} points of the first pass are missing in the second: {}",
                                 grouped(impl.remaining.total()), kChanged));
  }
  for (std::size_t tile = 0; tile < impl.untouched.size(); ++tile) {
    if (impl.untouched[tile]) impl.close(tile);
  }
  return {impl.spooled.points(), impl.spooled.written_bytes()};
}

PartitionResult partition_points(io::InputSet& inputs, const Survey& survey, const TilePlan& plan,
                                 const PartitionOptions& options, const std::function<void(std::size_t tile)>& closed,
                                 ProgressSink& progress, const CancelToken& cancel) {
  Partitioner partitioner(survey.counts, plan, options, closed);
  MappedReader reader(inputs, survey.lattice);
  const auto for_each_run = [](const MappedPoints& points, const auto& visit) {
    for_each_mapped_run(points.outcome, [&](std::size_t begin, std::size_t end) {
      visit(std::span(points.positions).subspan(begin, end - begin), points.batch.first_id + begin);
    });
  };
  progress.phase("partition", inputs.points());
  read_ahead<CountedPoints>(
      [&](CountedPoints& next) {
        if (!reader.read(next.points)) return false;
        next.complete.clear();
        for_each_run(next.points, [&](std::span<const LatticePoint> run, std::uint64_t first_id) {
          partitioner.count(run, first_id, next.complete);
        });
        return true;
      },
      [&](const CountedPoints& next) {
        cancel.check();
        for_each_run(next.points, [&](std::span<const LatticePoint> run, std::uint64_t first_id) {
          partitioner.spool(run, first_id);
        });
        partitioner.close(next.complete);
        progress.advance(next.points.batch.count);
      });
  return partitioner.finish();
}

}  // namespace arris::tiling
