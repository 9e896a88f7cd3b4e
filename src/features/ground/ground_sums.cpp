#include "features/ground/ground_sums.h"

#include <cmath>
#include <utility>

namespace arris {
namespace {

constexpr double kSteps = 1 << GroundSums::kStepBits;  // Per unit.

void add_cell(GroundSums::Cell& sum, const GroundSums::Cell& part) {
  sum.x += part.x;
  sum.y += part.y;
  sum.z += part.z;
  sum.count += part.count;
}

}  // namespace

GroundSums::Cell& GroundSums::cell(std::int64_t cell_x, std::int64_t cell_y) {
  const GroundBlockKey key = ground_block_of(cell_x, cell_y);
  if (last_block_ == nullptr || key != last_key_) {
    std::unique_ptr<Block>& block = blocks_[key];
    if (!block) block = std::make_unique<Block>();
    last_key_ = key;
    last_block_ = block.get();
  }
  return (*last_block_)[ground_cell_index(cell_x, cell_y)];
}

void GroundSums::add(double x, double y, double z) {
  // Also false for NaN.
  if (!(std::abs(x) <= kMostCoordinate && std::abs(y) <= kMostCoordinate && std::abs(z) <= kMostHeight)) return;
  const auto steps_x = static_cast<std::int64_t>(std::floor(x * kSteps));
  const auto steps_y = static_cast<std::int64_t>(std::floor(y * kSteps));
  const int shift = kStepBits + level_;
  const std::int64_t mask = (std::int64_t{1} << shift) - 1;
  Cell& sum = cell(steps_x >> shift, steps_y >> shift);
  add_cell(sum, {steps_x & mask, steps_y & mask, static_cast<std::int64_t>(std::floor(z * kSteps + 0.5)), 1});
  keep_bound();
}

void GroundSums::keep_bound() {
  while (blocks_.size() > kMostBlocks) coarsen();
}

void GroundSums::coarsen() {
  const GroundBlocks<Block> fine = take_blocks();
  ++level_;
  add_blocks(fine, level_ - 1);
}

void GroundSums::merge(const GroundSums& other) {
  while (level_ < other.level_) coarsen();
  add_blocks(other.blocks_, other.level_);
  keep_bound();
}

void GroundSums::add_blocks(const GroundBlocks<Block>& blocks, int level) {
  const int up = level_ - level;
  const std::int64_t within = (std::int64_t{1} << up) - 1;
  const int shift = kStepBits + level;
  for (const auto& [key, block] : blocks) {
    for (std::size_t i = 0; i < block->size(); ++i) {
      Cell part = (*block)[i];
      if (part.count == 0) continue;
      const std::int64_t x = std::int64_t{key.x} * kGroundBlockSide + static_cast<std::int64_t>(i % kGroundBlockSide);
      const std::int64_t y = std::int64_t{key.y} * kGroundBlockSide + static_cast<std::int64_t>(i / kGroundBlockSide);
      part.x += ((x & within) << shift) * part.count;
      part.y += ((y & within) << shift) * part.count;
      add_cell(cell(x >> up, y >> up), part);
    }
  }
}

GroundBlocks<GroundSums::Block> GroundSums::take_blocks() {
  last_block_ = nullptr;
  return std::exchange(blocks_, {});
}

}  // namespace arris
