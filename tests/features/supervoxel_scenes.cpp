#include "supervoxel_scenes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "features/numerics/symmetric_eigen3.h"

namespace arris::test {
namespace {

using Key = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

std::int64_t floor_div(std::int64_t a, std::int64_t b) {
  return a / b - (a % b < 0);
}

Key cell_of(const LatticePoint& p, std::int64_t side) {
  return {floor_div(p.x, side), floor_div(p.y, side), floor_div(p.z, side)};
}

void describe(const std::vector<LatticePoint>& members, SupervoxelTable& table, std::size_t label) {
  if (members.empty()) return;
  const LatticePoint& o = members[0];
  double n = 0, s[3] = {}, ss[6] = {};
  for (const LatticePoint& p : members) {
    const double d[3] = {double(p.x) - o.x, double(p.y) - o.y, double(p.z) - o.z};
    n += 1.0;
    for (int i = 0; i < 3; ++i) s[i] += d[i];
    ss[0] += d[0] * d[0];
    ss[1] += d[0] * d[1];
    ss[2] += d[0] * d[2];
    ss[3] += d[1] * d[1];
    ss[4] += d[1] * d[2];
    ss[5] += d[2] * d[2];
  }
  const double m[3] = {s[0] / n, s[1] / n, s[2] / n};
  for (int i = 0; i < 3; ++i) {
    // On a grid, so that it moves exactly with the scan.
    table.centroid[label][static_cast<std::size_t>(i)] = o[i] + std::round(m[i] * 1024.0) / 1024.0;
  }
  const SymmetricMatrix<double> c{ss[0] / n - m[0] * m[0], ss[1] / n - m[0] * m[1], ss[2] / n - m[0] * m[2],
                                  ss[3] / n - m[1] * m[1], ss[4] / n - m[1] * m[2], ss[5] / n - m[2] * m[2]};
  const PrincipalFrame frame = principal_frame(c);
  if (members.size() < 3 || frame.values.middle <= 1e-9 * frame.values.largest) return;
  for (std::size_t i = 0; i < 3; ++i) table.normal[label][i] = static_cast<float>(frame.e3[i]);
  table.thickness[label] = static_cast<float>(std::sqrt(std::max(frame.values.smallest, 0.0)));
  // A uniform rectangle has the variances a²/12 and b²/12.
  table.spacing[label] =
      static_cast<float>(std::sqrt(12.0 * std::sqrt(frame.values.largest * frame.values.middle) / n));
}

Supervoxels finish(std::span<const LatticePoint> positions, std::vector<std::uint32_t> labels, std::int32_t voxel) {
  Supervoxels made;
  made.table = table_of(positions, labels, voxel);
  made.labels = std::move(labels);
  return made;
}

}  // namespace

SupervoxelTable table_of(std::span<const LatticePoint> positions, const std::vector<std::uint32_t>& labels,
                         std::int32_t voxel) {
  const std::size_t count = labels.empty() ? 1 : std::size_t{1} + *std::max_element(labels.begin(), labels.end());
  SupervoxelTable table;
  table.normal.assign(count, {0.0F, 0.0F, 0.0F});
  table.centroid.assign(count, {0.0, 0.0, 0.0});
  table.spacing.assign(count, 0.0F);
  table.thickness.assign(count, 0.0F);
  std::vector<std::vector<LatticePoint>> members(count);
  std::map<Key, std::set<std::uint32_t>> in_voxel;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (labels[i] == 0) continue;
    members[labels[i]].push_back(positions[i]);
    in_voxel[cell_of(positions[i], voxel)].insert(labels[i]);
  }
  for (std::size_t label = 1; label < count; ++label) {
    std::sort(members[label].begin(), members[label].end());
    describe(members[label], table, label);
  }
  std::vector<std::set<std::uint32_t>> neighbours(count);
  for (const auto& [key, here] : in_voxel) {
    const auto [x, y, z] = key;
    for (int i = 0; i < 27; ++i) {
      const auto found = in_voxel.find({x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1});
      if (found == in_voxel.end()) continue;
      for (const std::uint32_t a : here) {
        for (const std::uint32_t b : found->second) {
          if (a != b) neighbours[a].insert(b);
        }
      }
    }
  }
  table.begin.push_back(0);
  for (const auto& of : neighbours) {
    table.neighbours.insert(table.neighbours.end(), of.begin(), of.end());
    table.begin.push_back(static_cast<std::uint32_t>(table.neighbours.size()));
  }
  return table;
}

Supervoxels supervoxels_of(const Scene& scene, const TilePoints& tile, double step, const SupervoxelShape& shape) {
  const auto cell = static_cast<std::int64_t>(std::lround(shape.cell * scene.spacing / step));
  const auto voxel = static_cast<std::int32_t>(std::lround(shape.voxel * scene.spacing / step));
  std::map<std::pair<std::uint32_t, Key>, std::uint32_t> label_of;
  std::vector<std::uint32_t> labels(tile.positions.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    // Noise must not carry a point into a cell of its own: cells are offset from the faces by a part of their size.
    LatticePoint p = tile.positions[i];
    const auto shift = static_cast<std::int32_t>(cell * 3 / 7);
    p = {p.x + shift, p.y + shift, p.z + shift};
    const auto number = static_cast<std::uint32_t>(label_of.size() + 1);
    labels[i] = label_of.try_emplace({scene.faces[tile.ids[i]], cell_of(p, cell)}, number).first->second;
  }
  if (shape.whole_voxels) {
    std::map<Key, std::map<std::uint32_t, int>> votes;
    for (std::size_t i = 0; i < labels.size(); ++i) ++votes[cell_of(tile.positions[i], voxel)][labels[i]];
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const auto& here = votes[cell_of(tile.positions[i], voxel)];
      labels[i] = std::max_element(here.begin(), here.end(), [](const auto& a, const auto& b) {
                    return a.second < b.second;
                  })->first;
    }
  }
  return finish(tile.positions, std::move(labels), voxel);
}

Supervoxels cubic_supervoxels(std::span<const LatticePoint> positions, std::int32_t cell, std::int32_t voxel) {
  std::map<Key, std::uint32_t> label_of;
  std::vector<std::uint32_t> labels(positions.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto number = static_cast<std::uint32_t>(label_of.size() + 1);
    labels[i] = label_of.try_emplace(cell_of(positions[i], cell), number).first->second;
  }
  return finish(positions, std::move(labels), voxel);
}

}  // namespace arris::test
