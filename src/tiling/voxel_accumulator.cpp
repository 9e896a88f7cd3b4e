#include "tiling/voxel_accumulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "core/stages.h"
#include "tiling/voxel_merge.h"
#include "tiling/voxel_run.h"
#include "tiling/voxel_store_filler.h"
#include "tiling/voxel_store_parts.h"
#include "tiling/voxel_sums.h"
#include "tiling/voxel_table.h"

namespace arris::tiling {
namespace {

// Large writes are cheaper, up to here.
constexpr std::size_t kMostWriteBytes = 512 * 1024;
// A batch of points, counters of the sort, voxels on their way to the store, and the rest.
constexpr std::size_t kFixedBytes = 96 * 1024 + VoxelStoreFiller::kMemoryBytes;
// Records of a run on their way to it; as many as of a store have room.
constexpr std::size_t kPartRecords = VoxelStoreFiller::kRecords;
// Runs merged at a time: few enough for the system's limit of open files.
constexpr std::size_t kMostRuns = 128;
constexpr std::size_t kLeastReadBytes = 64 * 1024;
constexpr std::size_t kMostReadBytes = 1024 * 1024;

/// Adds to `sums` if the sums still fit.
bool combine(VoxelRecord& sums, const VoxelRecord& more, std::uint32_t most_points) {
  if (!(sums.sums.key == more.sums.key)) return false;
  if (std::uint64_t{sums.sums.points} + more.sums.points > most_points) return false;
  sums.sums.points += more.sums.points;
  for (std::size_t axis = 0; axis < 3; ++axis) sums.sums.offset[axis] += more.sums.offset[axis];
  for (std::size_t channel = 0; channel < 3; ++channel) sums.colour[channel] += more.colour[channel];
  return true;
}

}  // namespace

struct VoxelAccumulator::Impl {
  Impl(const VoxelGrid& of, Options options)
      : grid(of),
        folder(std::move(options.folder)),
        most_index_bytes(options.most_index_bytes),
        write_bytes(std::min(options.table_bytes / 16, kMostWriteBytes)),
        free_bytes(options.table_bytes - std::min(kFixedBytes + write_bytes, options.table_bytes / 2)),
        table(std::in_place, of, free_bytes, options.likely_voxels) {}

  void look_at(std::span<const LatticePoint> positions, std::span<const RawColour> colours) {
    points += positions.size();
    for (const RawColour& colour : colours)
      largest_colour = std::max({largest_colour, colour[0], colour[1], colour[2]});
  }
  std::unique_ptr<VoxelRun> new_run(bool colours) {
    return std::make_unique<VoxelRun>(folder / fmt::format("voxels-{}.run", runs_made++), colours, write_bytes);
  }
  void keep(std::unique_ptr<VoxelRun> run) {
    run->close();
    run_bytes += run->size_bytes();
    runs.push_back(std::move(run));
    most_bytes = std::max(most_bytes, run_bytes);
  }
  void drop(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) run_bytes -= runs[i]->size_bytes();
    runs.erase(runs.begin(), runs.begin() + static_cast<std::ptrdiff_t>(count));
  }

  /// The table's sums lie anywhere: they are collected in their order by all threads.
  void spill() {
    auto run = new_run(table->has_colours());
    {
      const VoxelTable::Sorted sums = table->sorted();
      std::array<std::vector<VoxelRecord>, VoxelStoreFiller::kPlaces> parts;
      std::array<std::size_t, VoxelStoreFiller::kPlaces> begins{};
      std::size_t next = 0;
      const auto take = [&](std::size_t place) {
        begins[place] = std::exchange(next, std::min(next + kPartRecords, sums.size()));
        return begins[place] < sums.size();
      };
      const auto collect = [&](std::size_t place) {
        parts[place].clear();
        const std::size_t end = std::min(begins[place] + kPartRecords, sums.size());
        for (std::size_t i = begins[place]; i < end; ++i) parts[place].push_back(sums[i]);
      };
      const auto append = [&](std::size_t place) { run->append(parts[place]); };
      run_stages(parts.size(), take, {{StageOrder::kAnyOrder, collect}, {StageOrder::kInTurn, append}});
    }
    table->clear();
    keep(std::move(run));
  }

  std::size_t read_bytes(std::size_t count) const {
    return std::clamp(free_bytes / count, sizeof(VoxelRecord), kMostReadBytes);
  }

  /// Replaces the first `count` runs by one at the end.
  void merge_first(std::size_t count) {
    const auto first = std::span(runs).first(count);
    const bool colours = std::ranges::any_of(first, [](const auto& run) { return run->has_colours(); });
    const std::uint32_t most_points = most_points_summed(grid.side_steps(), colours);
    auto merged = new_run(colours);
    {
      VoxelMerge merge(first, read_bytes(count));
      VoxelRecord sums, record;
      bool any = merge.next(sums);
      while (any && merge.next(record)) {
        if (combine(sums, record, most_points)) continue;
        merged->append(sums);
        sums = record;
      }
      if (any) merged->append(sums);
    }
    keep(std::move(merged));
    drop(count);
  }

  void merge_into(VoxelStoreFiller& filler) {
    const std::size_t fan_in = std::clamp<std::size_t>(free_bytes / kLeastReadBytes, 2, kMostRuns);
    while (runs.size() > fan_in) merge_first(std::min(fan_in, runs.size() - fan_in + 1));
    VoxelMerge merge(runs, read_bytes(runs.size()));
    filler.add_all([&](std::vector<VoxelRecord>& records) { return merge.next(records, VoxelStoreFiller::kRecords); });
  }

  VoxelGrid grid;
  std::filesystem::path folder;
  std::uint64_t most_index_bytes;
  std::size_t write_bytes;  // For the buffer of the file being written.
  std::size_t free_bytes;   // For the table, later for reading runs.
  std::optional<VoxelTable> table;
  std::vector<std::unique_ptr<VoxelRun>> runs;
  std::uint64_t runs_made = 0;
  std::uint64_t run_bytes = 0;
  std::uint64_t most_bytes = 0;
  std::uint64_t points = 0;
  std::uint16_t largest_colour = 0;
};

VoxelAccumulator::VoxelAccumulator(const VoxelGrid& grid, Options options)
    : impl_(std::make_unique<Impl>(grid, std::move(options))) {}
VoxelAccumulator::~VoxelAccumulator() = default;

void VoxelAccumulator::add(std::span<const LatticePoint> positions, std::span<const RawColour> colours) {
  impl_->look_at(positions, colours);
  while (!impl_->table->add(positions, colours)) impl_->spill();
}

void VoxelAccumulator::add_all(const std::function<bool(VoxelPoints& points)>& fill) {
  VoxelPoints first;  // By it the table knows whether there are colours.
  while (first.positions.empty()) {
    if (!fill(first)) return;
  }
  add(first.positions, first.colours);
  first = {};
  const std::function<bool(VoxelPoints&)> fill_counted = [&](VoxelPoints& points) {
    if (!fill(points)) return false;
    impl_->look_at(points.positions, points.colours);
    return true;
  };
  VoxelStream stream(*impl_->table, fill_counted);
  while (!stream.run()) impl_->spill();
}

VoxelStore VoxelAccumulator::finish() {
  Impl& impl = *impl_;
  const bool colours =
      impl.table->has_colours() || std::ranges::any_of(impl.runs, [](const auto& run) { return run->has_colours(); });
  auto store = std::make_unique<VoxelStore::Impl>(impl.grid, impl.folder / "voxels.store", impl.write_bytes, colours);
  VoxelStoreFiller filler(store->file, store->index, impl.most_index_bytes);
  if (impl.runs.empty()) {
    filler.add_all(impl.table->sorted());
    impl.table.reset();
  } else {
    if (!impl.table->empty()) impl.spill();
    impl.table.reset();
    impl.merge_into(filler);
  }
  store->file.finish();
  store->index.finish();
  store->points = impl.points;
  store->largest_colour = impl.largest_colour;
  impl.most_bytes = std::max(impl.most_bytes, impl.run_bytes + store->file.size_bytes());
  impl.drop(impl.runs.size());
  return VoxelStore(std::move(store));
}

std::uint64_t VoxelAccumulator::bytes_on_disk() const {
  return impl_->most_bytes;
}

}  // namespace arris::tiling
