#include "tiling/voxel_selection.h"

#include <algorithm>
#include <cstddef>
#include <ranges>

namespace arris::tiling {
namespace {

constexpr std::size_t kFew = 8;

/// Goes down the halves of a cube in Z-order, each with the run of blocks that lie in it.
class Selection {
 public:
  Selection(const VoxelIndex& index, const LatticeBox& blocks) : index_(index), wanted_(blocks) {}

  void visit(std::size_t begin, std::size_t end, const LatticeBox& cube, int axis) {
    if (begin == end || !cube.intersects(wanted_)) return;
    if (contained(cube)) return take(begin, end);
    if (end - begin <= kFew) {
      for (std::size_t i = begin; i < end; ++i) {
        if (wanted_.contains(index_.block(i).key)) take(i, i + 1);
      }
      return;
    }
    const std::int64_t middle = (cube.min[axis] + cube.max[axis]) / 2;
    const auto range = std::views::iota(begin, end);
    const std::size_t split =
        *std::ranges::partition_point(range, [&](std::size_t i) { return index_.block(i).key[axis] < middle; });
    LatticeBox low = cube, high = cube;
    low.max[axis] = high.min[axis] = middle;
    visit(begin, split, low, (axis + 1) % 3);
    visit(split, end, high, (axis + 1) % 3);
  }
  std::vector<BlockRange>& ranges() { return ranges_; }

 private:
  bool contained(const LatticeBox& cube) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (cube.min[axis] < wanted_.min[axis] || cube.max[axis] > wanted_.max[axis]) return false;
    }
    return true;
  }
  void take(std::size_t begin, std::size_t end) {
    if (!ranges_.empty() && ranges_.back().end == begin) {
      ranges_.back().end = end;
    } else {
      ranges_.push_back({begin, end});
    }
  }

  const VoxelIndex& index_;
  LatticeBox wanted_;
  std::vector<BlockRange> ranges_;
};

}  // namespace

std::vector<BlockRange> select_blocks(const VoxelIndex& index, const LatticeBox& keys) {
  constexpr std::int64_t kEnd = std::int64_t{1} << 28;  // Of the keys of blocks.
  LatticeBox blocks;
  for (int axis = 0; axis < 3; ++axis) {
    blocks.min[axis] = std::max(keys.min[axis], index.bounds().min[axis]) >> 3;
    blocks.max[axis] = (std::min(keys.max[axis], index.bounds().max[axis]) + 7) >> 3;
  }
  if (keys.empty() || !keys.intersects(index.bounds())) return {};
  Selection selection(index, blocks);
  selection.visit(0, index.blocks(), {{-kEnd, -kEnd, -kEnd}, {kEnd, kEnd, kEnd}}, 0);
  return std::move(selection.ranges());
}

}  // namespace arris::tiling
