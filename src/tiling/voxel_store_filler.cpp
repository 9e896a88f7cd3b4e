#include "tiling/voxel_store_filler.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

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
    : file_(file), index_(index), most_index_bytes_(most_index_bytes) {
  if (loop_threads() > 1) filling_.emplace(1);
}

void VoxelStoreFiller::add(const VoxelRecord& record) {
  if (!total_ || !(total_->key() == record.sums.key)) {
    complete();
    total_.emplace(record.sums.key);
  }
  total_->add(record);
}

void VoxelStoreFiller::add_sorted(const VoxelTable::Sorted& records) {
  constexpr std::size_t kBlock = kPart * kParts;
  for (std::size_t begin = 0; begin < records.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, records.size() - begin);
    parallel_for_chunks(count, kPart, [&](std::size_t first, std::size_t last) {
      sum_part(records, begin + first, begin + last, summed_[first / kPart]);
    });
    fill();
  }
}

void VoxelStoreFiller::finish() {
  complete();
  fill();
  if (filling_) filling_->wait();
}

void VoxelStoreFiller::complete() {
  if (!total_) return;
  summed_[0].push_back(total_->mean());
  total_.reset();
  if (summed_[0].size() == kPart * kParts / 2) fill();
}

void VoxelStoreFiller::fill() {
  if (filling_) filling_->wait();
  std::swap(summed_, taken_);
  for (std::vector<Voxel>& part : summed_) part.clear();
  if (filling_) {
    filling_->run([this] { append_taken(); });
  } else {
    append_taken();
  }
}

void VoxelStoreFiller::append_taken() {
  for (const std::vector<Voxel>& part : taken_) {
    for (const Voxel& voxel : part) file_.append(voxel);
    for (const Voxel& voxel : part) {
      if (index_.size() == VoxelIndex::kNone - 1)
        throw BudgetError(fmt::format("more than {} voxels; choose a larger --voxel", index_.size()));
      index_.append(voxel.key);
    }
  }
  // The directory comes on top when all blocks are known.
  if (index_.memory_bytes() + index_.blocks() * kDirectoryBytes <= most_index_bytes_) return;
  throw BudgetError(fmt::format(
      "the index of more than {} voxels does not fit into what --memory leaves; raise it, or choose a larger --voxel",
      grouped(index_.size())));
}

}  // namespace arris::tiling
