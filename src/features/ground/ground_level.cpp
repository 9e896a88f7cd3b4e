#include "features/ground/ground_level.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace arris {
namespace {

/// Steeper than this the coarse surface is no slope but a cliff that it blurs.
constexpr double kSteepest = 1.0;

/// Mean of the points of four cells, from the centre of the cell that they make up.
void add_quarter(GroundMean& whole, const GroundMean& quarter, int column, int row) {
  if (quarter.count == 0.0) return;
  const double share = quarter.count / (whole.count + quarter.count);
  const double dx = 0.5 * static_cast<double>(quarter.dx) + (column == 0 ? -0.25 : 0.25);
  const double dy = 0.5 * static_cast<double>(quarter.dy) + (row == 0 ? -0.25 : 0.25);
  whole.dx = static_cast<float>(whole.dx + share * (dx - whole.dx));
  whole.dy = static_cast<float>(whole.dy + share * (dy - whole.dy));
  whole.z += share * (quarter.z - whole.z);
  whole.count += quarter.count;
}

}  // namespace

GroundBlocks<GroundMeans> coarser_means(const GroundBlocks<GroundMeans>& means) {
  constexpr int kHalf = kGroundBlockSide / 2;
  GroundBlocks<GroundMeans> coarser;
  for (const auto& [key, block] : means) {
    std::unique_ptr<GroundMeans>& parent = coarser[{key.x >> 1, key.y >> 1}];
    if (!parent) parent = std::make_unique<GroundMeans>();
    for (int j = 0; j < kGroundBlockSide; ++j) {
      for (int i = 0; i < kGroundBlockSide; ++i) {
        GroundMean& whole = (*parent)[ground_cell_index((key.x & 1) * kHalf + i / 2, (key.y & 1) * kHalf + j / 2)];
        add_quarter(whole, (*block)[ground_cell_index(i, j)], i & 1, j & 1);
      }
    }
  }
  return coarser;
}

GroundLevel::GroundLevel(double cell_size, const GroundBlocks<GroundMeans>& means, const GroundBounds& bounds,
                         int sweeps, const Surface& coarse)
    : cell_size_(cell_size) {
  for (const auto& [key, block] : means) start(key, *block, coarse);
  for (int i = 0; i < sweeps; ++i) {
    exchange_rings(bounds);
    sweep();
  }
  exchange_rings(bounds);
}

/// How much higher the coarse surface is at the centre of a cell than at its mean.
double GroundLevel::carried(const GroundMean& mean, double at_centre, double x, double y, const Surface& coarse) const {
  const double dx = cell_size_ * static_cast<double>(mean.dx);
  const double dy = cell_size_ * static_cast<double>(mean.dy);
  const double most = kSteepest * (std::abs(dx) + std::abs(dy));
  return std::clamp(at_centre - coarse(x + dx, y + dy), -most, most);
}

void GroundLevel::start(const GroundBlockKey& key, const GroundMeans& means, const Surface& coarse) {
  auto heights = std::make_unique<Heights>();
  for (int j = -1; j <= kGroundBlockSide; ++j) {
    for (int i = -1; i <= kGroundBlockSide; ++i) {
      const double x = centre(key.x, i);
      const double y = centre(key.y, j);
      double& height = heights->at[index(i, j)];
      height = coarse(x, y);
      if (i < 0 || j < 0 || i == kGroundBlockSide || j == kGroundBlockSide) continue;
      const std::size_t cell = ground_cell_index(i, j);
      const GroundMean& mean = means[cell];
      if (mean.count == 0.0) continue;
      height = mean.z + carried(mean, height, x, y, coarse);
      heights->known[cell] = true;
    }
  }
  blocks_.emplace(key, std::move(heights));
}

/// Rings take the cells of the neighbours that are there, out of the bounds those beside them, and else stay.
void GroundLevel::exchange_rings(const GroundBounds& bounds) {
  const auto beyond = [](int i) { return i < 0 ? -1 : i == kGroundBlockSide ? 1 : 0; };
  for (const auto& [key, block] : blocks_) {
    std::array<const Heights*, 9> neighbours{};
    for (int n = 0; n < 9; ++n) {
      const auto found = blocks_.find({key.x + n % 3 - 1, key.y + n / 3 - 1});
      neighbours[static_cast<std::size_t>(n)] = found == blocks_.end() ? nullptr : found->second.get();
    }
    for (int j = -1; j <= kGroundBlockSide; ++j) {
      const int step = beyond(j) == 0 ? kGroundBlockSide + 1 : 1;  // Whole rows above and below, else both ends.
      for (int i = -1; i <= kGroundBlockSide; i += step) {
        const Heights* neighbour = neighbours[static_cast<std::size_t>(3 * (beyond(j) + 1) + beyond(i) + 1)];
        double& height = block->at[index(i, j)];
        if (neighbour != nullptr) {
          height = neighbour->at[index(i - beyond(i) * kGroundBlockSide, j - beyond(j) * kGroundBlockSide)];
        } else if (!bounds.contains(centre(key.x, i), centre(key.y, j))) {
          height = block->at[index(i - beyond(i), j - beyond(j))];
        }
      }
    }
  }
}

/// One round of Jacobi's method for the cells without points: each becomes the mean of its four neighbours.
void GroundLevel::sweep() {
  for (const auto& [key, block] : blocks_) {
    if (block->known.all()) continue;
    const auto before = block->at;
    for (int j = 0; j < kGroundBlockSide; ++j) {
      for (int i = 0; i < kGroundBlockSide; ++i) {
        if (block->known[ground_cell_index(i, j)]) continue;
        block->at[index(i, j)] = 0.25 * ((before[index(i - 1, j)] + before[index(i + 1, j)]) +
                                         (before[index(i, j - 1)] + before[index(i, j + 1)]));
      }
    }
  }
}

bool GroundLevel::height_at(double x, double y, double& height) const {
  const double u = x / cell_size_;
  const double v = y / cell_size_;
  const GroundBlockKey key =
      ground_block_of(static_cast<std::int64_t>(std::floor(u)), static_cast<std::int64_t>(std::floor(v)));
  const auto found = blocks_.find(key);
  if (found == blocks_.end()) return false;
  // Cells from here on are counted in the block; the centre of cell i is at i + 0.5.
  const double in_x = u - static_cast<double>(key.x) * kGroundBlockSide - 0.5;
  const double in_y = v - static_cast<double>(key.y) * kGroundBlockSide - 0.5;
  const int i = static_cast<int>(std::floor(in_x));
  const int j = static_cast<int>(std::floor(in_y));
  const double across = in_x - i;
  const double along = in_y - j;
  const double* const corner = &found->second->at[index(i, j)];
  const double below = corner[0] + across * (corner[1] - corner[0]);
  const double above = corner[kSide] + across * (corner[kSide + 1] - corner[kSide]);
  height = below + along * (above - below);
  return true;
}

}  // namespace arris
