#include "evaluate/label_boundary.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "core/error.h"
#include "core/parallel.h"
#include "evaluate/box_tree.h"
#include "evaluate/evaluation_setup.h"

namespace arris::evaluate {

namespace {

constexpr int kAxisBits = 21;                        // Three axes in a key of 64 bits.
constexpr double kMostCells = (1 << kAxisBits) - 3;  // Per axis; one more on each side stays empty.
constexpr std::uint64_t kNextX = std::uint64_t{1} << (2 * kAxisBits);
constexpr std::uint64_t kNextY = std::uint64_t{1} << kAxisBits;
constexpr std::size_t kGrain = 512;  // Cells.

/// The points in cells of side `radius`, sorted by cell and label.
class LabelGrid {
 public:
  LabelGrid(std::span<const LabelledPoint> points, std::uint32_t LabelledPoint::*label, double radius)
      : points_(points), squared_(radius * radius) {
    Box3 box;
    for (const LabelledPoint& p : points) {
      if (is_judged(p)) box.include(p.position);
    }
    const Vec3 size = box.max - box.min;
    if (std::max({size.x, size.y, size.z}) / radius > kMostCells) {
      throw ConfigError(
          "the radius of boundary points is less than a millionth of the cloud's extent; give a larger one");
    }
    const auto cell = [radius](double offset) { return static_cast<std::uint64_t>(offset / radius) + 1; };
    entries_.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!is_judged(points[i])) continue;
      const Vec3 offset = points[i].position - box.min;
      const std::uint64_t key = cell(offset.x) * kNextX + cell(offset.y) * kNextY + cell(offset.z);
      entries_.push_back({key, points[i].*label, static_cast<std::uint32_t>(i)});
    }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
      return std::tie(a.key, a.label, a.point) < std::tie(b.key, b.label, b.point);
    });
    for (std::uint32_t i = 0; i < entries_.size(); ++i) {
      const bool new_cell = i == 0 || entries_[i].key != entries_[i - 1].key;
      if (new_cell) cells_.push_back({entries_[i].key, static_cast<std::uint32_t>(runs_.size())});
      if (new_cell || entries_[i].label != entries_[i - 1].label) runs_.push_back({entries_[i].label, i});
    }
    cells_.push_back({~std::uint64_t{0}, static_cast<std::uint32_t>(runs_.size())});
    runs_.push_back({0, static_cast<std::uint32_t>(entries_.size())});
  }

  std::size_t cells() const { return cells_.size() - 1; }

  /// Sets flags[i] for the boundary points of one cell. @param near  scratch.
  void mark(std::size_t cell, std::vector<std::uint32_t>& near, std::vector<std::uint8_t>& flags) const {
    near.clear();
    add_runs(cell, cell + 1, near);  // The cell itself first: most boundary points have their witness there.
    constexpr std::array<std::uint64_t, 9> kColumns{0 - kNextX - kNextY, 0 - kNextX, 0 - kNextX + kNextY,
                                                    0 - kNextY,          0,          kNextY,
                                                    kNextX - kNextY,     kNextX,     kNextX + kNextY};
    for (const std::uint64_t column : kColumns) {
      const std::uint64_t middle = cells_[cell].key + column;  // Of three cells whose keys follow each other.
      auto other = std::lower_bound(cells_.begin(), cells_.end() - 1, middle - 1,
                                    [](const Cell& c, std::uint64_t key) { return c.key < key; });
      for (; other->key <= middle + 1; ++other) {
        const auto index = static_cast<std::size_t>(other - cells_.begin());
        if (index != cell) add_runs(index, index + 1, near);
      }
    }
    const auto label_of = [&](std::uint32_t run) { return runs_[run].label; };
    if (std::all_of(near.begin(), near.end(), [&](std::uint32_t run) { return label_of(run) == label_of(near[0]); }))
      return;
    for (std::uint32_t run = cells_[cell].first_run; run < cells_[cell + 1].first_run; ++run) {
      for (std::uint32_t i = runs_[run].begin; i < runs_[run + 1].begin; ++i) {
        const Vec3& p = points_[entries_[i].point].position;
        flags[entries_[i].point] = std::any_of(near.begin(), near.end(), [&](std::uint32_t other) {
          return label_of(other) != label_of(run) && holds_neighbour(other, p);
        });
      }
    }
  }

 private:
  struct Entry {
    std::uint64_t key;
    std::uint32_t label;
    std::uint32_t point;
  };
  /// Entries of one label in one cell, up to the next run's.
  struct Run {
    std::uint32_t label;
    std::uint32_t begin;
  };
  /// Runs up to the next cell's.
  struct Cell {
    std::uint64_t key;
    std::uint32_t first_run;
  };

  void add_runs(std::size_t begin, std::size_t end, std::vector<std::uint32_t>& near) const {
    for (std::uint32_t run = cells_[begin].first_run; run < cells_[end].first_run; ++run) near.push_back(run);
  }
  bool holds_neighbour(std::uint32_t run, const Vec3& p) const {
    for (std::uint32_t i = runs_[run].begin; i < runs_[run + 1].begin; ++i) {
      const Vec3 apart = points_[entries_[i].point].position - p;
      if (dot(apart, apart) <= squared_) return true;
    }
    return false;
  }

  std::span<const LabelledPoint> points_;
  double squared_;
  std::vector<Entry> entries_;
  std::vector<Run> runs_;    ///< And one that ends the last.
  std::vector<Cell> cells_;  ///< Likewise.
};

}  // namespace

std::vector<std::uint32_t> find_label_boundary(std::span<const LabelledPoint> points,
                                               std::uint32_t LabelledPoint::*label, double radius) {
  if (!(radius > 0.0) || !std::isfinite(radius)) throw ConfigError("the radius of boundary points must be above 0");
  const LabelGrid grid(points, label, radius * (1.0 + kToleranceSlack));
  std::vector<std::uint8_t> flags(points.size());
  parallel_for_chunks(grid.cells(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> near;
    for (std::size_t cell = begin; cell < end; ++cell) grid.mark(cell, near, flags);
  });
  std::vector<std::uint32_t> boundary;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (flags[i] != 0) boundary.push_back(static_cast<std::uint32_t>(i));
  }
  return boundary;
}

}  // namespace arris::evaluate
