#include "features/ground/ground_model.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <unordered_set>

namespace arris {
namespace {

constexpr std::size_t kMostModelBlocks = 2 * GroundSums::kMostBlocks;
/// Per level. A hole wider than this many cells is bridged by a coarser level, where it has fewer.
constexpr int kSweeps = 16;
/// Of the coarsest level, which starts from nothing: about the square of the cells along it.
constexpr int kTopSweeps = 1024;
constexpr double kStep = 1.0 / (1 << GroundSums::kStepBits);

/// Blocks next to the origin: no further level would join them.
constexpr std::array<GroundBlockKey, 4> kTopKeys{{{-1, -1}, {0, -1}, {-1, 0}, {0, 0}}};

/// The coarsest level.
bool is_top(const auto& keys) {
  return std::ranges::all_of(
      keys, [](const GroundBlockKey& key) { return key.x >= -1 && key.x <= 0 && key.y >= -1 && key.y <= 0; });
}

/// Blocks of all levels above sums like these, their own included.
std::size_t pyramid_blocks(const GroundBlocks<GroundSums::Block>& blocks) {
  std::unordered_set<GroundBlockKey, GroundBlockHash> keys;
  for (const auto& [key, block] : blocks) keys.insert(key);
  std::size_t count = keys.size();
  while (!is_top(keys)) {
    std::unordered_set<GroundBlockKey, GroundBlockHash> coarser;
    for (const GroundBlockKey& key : keys) coarser.insert({key.x >> 1, key.y >> 1});
    keys = std::move(coarser);
    count += keys.size();
  }
  return count;
}

GroundMean mean_of(const GroundSums::Cell& cell, double cell_size) {
  if (cell.count == 0) return {};
  const auto count = static_cast<double>(cell.count);
  // Coordinates were rounded down to their step.
  const auto offset = [&](std::int64_t sum) {
    return static_cast<float>((static_cast<double>(sum) / count + 0.5) * kStep / cell_size - 0.5);
  };
  return {offset(cell.x), offset(cell.y), static_cast<double>(cell.z) / count * kStep, count};
}

GroundBlocks<GroundMeans> means_of(GroundBlocks<GroundSums::Block> blocks, double cell_size) {
  GroundBlocks<GroundMeans> means;
  for (auto& [key, block] : blocks) {
    auto made = std::make_unique<GroundMeans>();
    for (std::size_t i = 0; i < made->size(); ++i) (*made)[i] = mean_of((*block)[i], cell_size);
    means.emplace(key, std::move(made));
    block.reset();
  }
  return means;
}

std::vector<GroundBlockKey> keys_of(const GroundBlocks<GroundMeans>& blocks) {
  std::vector<GroundBlockKey> keys;
  for (const auto& [key, block] : blocks) keys.push_back(key);
  return keys;
}

GroundBounds bounds_of(const GroundBlocks<GroundMeans>& means, double cell_size) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  GroundBounds bounds{kFar, kFar, -kFar, -kFar};
  for (const auto& [key, block] : means) {
    for (int cell = 0; cell < static_cast<int>(kGroundBlockCells); ++cell) {
      if ((*block)[static_cast<std::size_t>(cell)].count == 0.0) continue;
      const double x = (static_cast<double>(key.x) * kGroundBlockSide + cell % kGroundBlockSide + 0.5) * cell_size;
      const double y = (static_cast<double>(key.y) * kGroundBlockSide + cell / kGroundBlockSide + 0.5) * cell_size;
      bounds = {std::min(bounds.low_x, x), std::min(bounds.low_y, y), std::max(bounds.high_x, x),
                std::max(bounds.high_y, y)};
    }
  }
  return bounds;
}

/// Mean height of all points, whatever the order of blocks and cells: at the top there are four blocks at most.
double mean_height(const GroundBlocks<GroundMeans>& top) {
  double sum = 0.0;
  double count = 0.0;
  for (const GroundBlockKey& key : kTopKeys) {
    for (const GroundMean& mean : *top.at(key)) {
      sum += mean.count * mean.z;
      count += mean.count;
    }
  }
  return sum / count;
}

}  // namespace

GroundModel::GroundModel(GroundSums&& sums) {
  assert(!sums.empty());
  // Scattered islands of points have as many blocks in many levels.
  while (pyramid_blocks(sums.blocks()) > kMostModelBlocks) sums.coarsen();
  cell_size_ = std::ldexp(1.0, sums.level());
  std::vector<GroundBlocks<GroundMeans>> means;  // Finest first.
  means.push_back(means_of(sums.take_blocks(), cell_size_));
  bounds_ = bounds_of(means.front(), cell_size_);
  while (!is_top(keys_of(means.back()))) means.push_back(coarser_means(means.back()));
  for (const GroundBlockKey& key : kTopKeys) {
    std::unique_ptr<GroundMeans>& block = means.back()[key];  // All four, so that no place is without a height.
    if (!block) block = std::make_unique<GroundMeans>();
  }
  mean_ = mean_height(means.back());
  levels_.reserve(means.size());
  while (!means.empty()) {
    const std::size_t above = levels_.size();
    const double size = std::ldexp(cell_size_, static_cast<int>(means.size()) - 1);
    levels_.emplace_back(size, means.back(), bounds_, above == 0 ? kTopSweeps : kSweeps,
                         [&](double x, double y) { return surface(above, x, y); });
    means.pop_back();
  }
}

double GroundModel::surface(std::size_t level, double x, double y) const {
  double height = mean_;
  x = std::clamp(x, bounds_.low_x, bounds_.high_x);
  y = std::clamp(y, bounds_.low_y, bounds_.high_y);
  while (level > 0 && !levels_[level - 1].height_at(x, y, height)) --level;
  return height;
}

double GroundModel::height_at(double x, double y) const {
  return surface(levels_.size(), x, y);
}

std::size_t GroundModel::blocks() const {
  std::size_t count = 0;
  for (const GroundLevel& level : levels_) count += level.blocks();
  return count;
}

}  // namespace arris
