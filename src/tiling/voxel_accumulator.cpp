#include "tiling/voxel_accumulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"
#include "tiling/voxel_merge.h"
#include "tiling/voxel_run.h"
#include "tiling/voxel_store_parts.h"
#include "tiling/voxel_sums.h"
#include "tiling/voxel_table.h"

namespace arris::tiling {
namespace {

// Large writes are cheaper, up to here.
constexpr std::size_t kMostWriteBytes = 512 * 1024;
constexpr std::size_t kFilledTogether = 4096;
// A batch of points, counters of the sort, voxels on their way to the store, and the rest.
constexpr std::size_t kFixedBytes = 96 * 1024 + 2 * kFilledTogether * sizeof(Voxel);
// Runs merged at a time: few enough for the system's limit of open files.
constexpr std::size_t kMostRuns = 128;
constexpr std::uint64_t kDirectoryBytes = 8;  // Of the index, per block.
constexpr std::size_t kLeastReadBytes = 64 * 1024;
constexpr std::size_t kMostReadBytes = 1024 * 1024;

/// Records in, voxels out. Voxels are put into file and index on another thread while the next ones are summed, unless
/// loops may use one thread only.
class StoreFiller {
 public:
  StoreFiller(VoxelFile& file, VoxelIndex& index, std::uint64_t most_index_bytes)
      : file_(file), index_(index), most_index_bytes_(most_index_bytes) {
    summed_.reserve(kFilledTogether);
    taken_.reserve(kFilledTogether);
    if (loop_threads() > 1) filling_.emplace(1);
  }
  void add(const VoxelRecord& record) {
    if (!total_ || !(total_->key() == record.sums.key)) {
      complete();
      total_.emplace(record.sums.key);
    }
    total_->add(record);
  }
  /// Call it once all records are there.
  void finish() {
    complete();
    fill();
    if (filling_) filling_->wait();
  }

 private:
  void complete() {
    if (!total_) return;
    summed_.push_back(total_->mean());
    if (summed_.size() == kFilledTogether) fill();
    total_.reset();
  }

  void fill() {
    if (filling_) filling_->wait();
    taken_.clear();
    std::swap(summed_, taken_);
    if (filling_) {
      filling_->run([this] { append_taken(); });
    } else {
      append_taken();
    }
  }

  void append_taken() {
    for (const Voxel& voxel : taken_) file_.append(voxel);
    for (const Voxel& voxel : taken_) {
      if (index_.size() == VoxelIndex::kNone - 1)
        throw BudgetError(fmt::format("more than {} voxels; choose a larger --voxel", index_.size()));
      index_.append(voxel.key);
    }
    // The directory comes on top when all blocks are known.
    if (index_.memory_bytes() + index_.blocks() * kDirectoryBytes <= most_index_bytes_) return;
    throw BudgetError(fmt::format(
        "the index of more than {} voxels does not fit into what --memory leaves; raise it, or choose a larger --voxel",
        grouped(index_.size())));
  }

  VoxelFile& file_;
  VoxelIndex& index_;
  std::uint64_t most_index_bytes_;
  std::optional<VoxelTotal> total_;
  std::vector<Voxel> summed_, taken_;
  std::optional<BackgroundTasks> filling_;  // Of what is taken. Joined before that goes.
};

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

  void spill() {
    auto run = new_run(table->has_colours());
    table->drain([&](const VoxelRecord& record) { run->append(record); });
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

  void merge_into(StoreFiller& filler) {
    const std::size_t fan_in = std::clamp<std::size_t>(free_bytes / kLeastReadBytes, 2, kMostRuns);
    while (runs.size() > fan_in) merge_first(std::min(fan_in, runs.size() - fan_in + 1));
    VoxelMerge merge(runs, read_bytes(runs.size()));
    for (VoxelRecord record; merge.next(record);) filler.add(record);
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
  Impl& impl = *impl_;
  impl.points += positions.size();
  for (const RawColour& colour : colours) {
    impl.largest_colour = std::max({impl.largest_colour, colour[0], colour[1], colour[2]});
  }
  for (;;) {
    const std::size_t added = impl.table->add(positions, colours);
    if (added == positions.size()) return;
    impl.spill();
    positions = positions.subspan(added);
    if (!colours.empty()) colours = colours.subspan(added);
  }
}

VoxelStore VoxelAccumulator::finish() {
  Impl& impl = *impl_;
  const bool colours =
      impl.table->has_colours() || std::ranges::any_of(impl.runs, [](const auto& run) { return run->has_colours(); });
  auto store = std::make_unique<VoxelStore::Impl>(impl.grid, impl.folder / "voxels.store", impl.write_bytes, colours);
  StoreFiller filler(store->file, store->index, impl.most_index_bytes);
  if (impl.runs.empty()) {
    impl.table->drain([&](const VoxelRecord& record) { filler.add(record); });
    impl.table.reset();
  } else {
    if (!impl.table->empty()) impl.spill();
    impl.table.reset();
    impl.merge_into(filler);
  }
  filler.finish();
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
