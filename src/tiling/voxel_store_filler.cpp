#include "tiling/voxel_store_filler.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/text.h"

namespace arris::tiling {
namespace {

constexpr std::uint64_t kDirectoryBytes = 8;  // Of the index, per block.

/// The voxels whose first records are in [begin, end).
void sum_part(const VoxelTable::Sorted& records, std::size_t begin, std::size_t end, std::vector<Voxel>& voxels) {
  std::size_t i = begin;
  while (i > 0 && i < end && records.key(i) == records.key(i - 1)) ++i;
  while (i < end) {
    VoxelRecord record = records[i];
    VoxelTotal total(record.sums.key);
    for (;;) {
      total.add(record);
      if (++i == records.size() || !(records.key(i) == total.key())) break;
      record = records[i];
    }
    voxels.push_back(total.mean());
  }
}

}  // namespace

VoxelStoreFiller::VoxelStoreFiller(VoxelFile& file, VoxelIndex& index, std::uint64_t most_index_bytes)
    : file_(file), index_(index), most_index_bytes_(most_index_bytes) {}

void VoxelStoreFiller::add_all(const std::function<bool(std::vector<VoxelRecord>& records)>& fill) {
  struct Part {
    std::vector<VoxelRecord> records;
    std::vector<Voxel> summed;
  };
  std::array<Part, kPlaces> parts;
  const auto sum = [&](std::size_t place) {
    Part& part = parts[place];
    part.summed.clear();
    for (std::size_t i = 0; i < part.records.size();) {
      VoxelTotal total(part.records[i].sums.key);
      do {
        total.add(part.records[i]);
      } while (++i < part.records.size() && part.records[i].sums.key == total.key());
      part.summed.push_back(total.mean());
    }
  };
  run_stages(parts.size(), [&](std::size_t place) { return fill(parts[place].records); },
             {{StageOrder::kAnyOrder, sum},
              {StageOrder::kInTurn, [&](std::size_t place) { file_.append(parts[place].summed); }},
              {StageOrder::kInTurn, [&](std::size_t place) { add_to_index(parts[place].summed); }}});
}

void VoxelStoreFiller::add_all(const VoxelTable::Sorted& records) {
  struct Part {
    std::size_t begin;
    std::vector<Voxel> summed;
  };
  std::array<Part, kPlaces> parts;
  std::size_t next = 0;
  const auto take = [&](std::size_t place) {
    if (next >= records.size()) return false;
    parts[place].begin = next;
    next += kPart;
    return true;
  };
  const auto sum = [&](std::size_t place) {
    Part& part = parts[place];
    part.summed.clear();
    sum_part(records, part.begin, std::min(part.begin + kPart, records.size()), part.summed);
  };
  run_stages(parts.size(), take,
             {{StageOrder::kAnyOrder, sum},
              {StageOrder::kInTurn, [&](std::size_t place) { file_.append(parts[place].summed); }},
              {StageOrder::kInTurn, [&](std::size_t place) { add_to_index(parts[place].summed); }}});
}

void VoxelStoreFiller::add_to_index(const std::vector<Voxel>& voxels) {
  for (const Voxel& voxel : voxels) {
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

}  // namespace arris::tiling
