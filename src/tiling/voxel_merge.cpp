#include "tiling/voxel_merge.h"

#include "tiling/morton.h"

namespace arris::tiling {

VoxelMerge::VoxelMerge(std::span<const std::unique_ptr<VoxelRun>> runs, std::size_t buffer_bytes)
    : buffers_(runs.size() * buffer_bytes), records_(runs.size()) {
  for (const auto& run : runs) {
    const auto number = static_cast<std::uint32_t>(runs_.size());
    runs_.push_back(run.get());
    run->open(buffers_.first(runs.size() * buffer_bytes).subspan(number * buffer_bytes, buffer_bytes));
    if (run->read(records_[number])) heap_.push_back({records_[number].sums.key, number});
  }
  for (std::size_t at = heap_.size() / 2; at > 0; --at) sift_down(at - 1);
  find_second();
}

bool VoxelMerge::next(std::vector<VoxelRecord>& records, std::size_t least) {
  records.clear();
  while (!heap_.empty() && (records.size() < least || heap_.front().key == records.back().sums.key)) {
    advance(records.emplace_back());
  }
  return !records.empty();
}

void VoxelMerge::advance(VoxelRecord& record) {
  Head& first = heap_.front();
  VoxelRecord& head = records_[first.run];
  record = head;
  if (runs_[first.run]->read(head)) {
    first.key = head.sums.key;
    if (heap_.size() == 1 || !z_order_less(heap_[second_].key, first.key)) return;
  } else {
    first = heap_.back();
    heap_.pop_back();
  }
  sift_down(0);
  find_second();
}

void VoxelMerge::find_second() {
  second_ = heap_.size() > 2 && z_order_less(heap_[2].key, heap_[1].key) ? 2 : 1;
}

void VoxelMerge::sift_down(std::size_t at) {
  const std::size_t size = heap_.size();
  if (at >= size) return;
  const Head moved = heap_[at];
  for (std::size_t child = 2 * at + 1; child < size; child = 2 * at + 1) {
    if (child + 1 < size && z_order_less(heap_[child + 1].key, heap_[child].key)) ++child;
    if (!z_order_less(heap_[child].key, moved.key)) break;
    heap_[at] = heap_[child];
    at = child;
  }
  heap_[at] = moved;
}

}  // namespace arris::tiling
