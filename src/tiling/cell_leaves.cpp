#include "tiling/cell_leaves.h"

#include <algorithm>
#include <utility>

namespace arris::tiling {
namespace {

constexpr std::size_t kLeastSlots = 64;

}  // namespace

CellLeaves::CellLeaves(const CellLeaves& other) {
  leaves_.reserve(other.size());
  for (const auto& leaf : other.leaves_) leaves_.push_back(std::make_unique<CellLeaf>(*leaf));
  if (!leaves_.empty()) make_slots(other.slots_.size());
}

CellLeaf& CellLeaves::add(const Cell& cell) {
  if (slots_.size() < 2 * (leaves_.size() + 1)) make_slots(std::max(kLeastSlots, 2 * slots_.size()));
  Cell origin = position_of(cell);
  Slot& slot = slots_[slot_of(origin)];
  slot.position = origin;
  slot.leaf = leaves_.emplace_back(std::make_unique<CellLeaf>()).get();
  for (std::int32_t& o : origin) o <<= kCellLeafLog2;
  slot.leaf->origin = origin;
  return *slot.leaf;
}

void CellLeaves::make_slots(std::size_t count) {
  slots_.assign(count, {});
  shift_ = 32 - std::countr_zero(slots_.size());
  for (const auto& leaf : leaves_) {
    const Cell position = position_of(leaf->origin);
    slots_[slot_of(position)] = {position, leaf.get()};
  }
}

std::vector<std::unique_ptr<CellLeaf>> CellLeaves::take() {
  slots_.clear();
  return std::exchange(leaves_, {});
}

}  // namespace arris::tiling
