#include "zheng_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/columns.h"
#include "features/planar/alpha_exposed.h"
#include "features/zheng/supervoxel_frame.h"
#include "features/zheng/supervoxel_pair.h"
#include "features/zheng/zheng_score.h"

namespace arris::test {
namespace {

class Reference {
 public:
  Reference(const TilePoints& tile, std::span<const std::uint32_t> labels, const SupervoxelTable& table,
            const ZhengSettings& settings)
      : tile_(tile), labels_(labels), table_(table), settings_(settings) {}

  ContourRecord record(std::size_t p) {
    ContourRecord record;
    if (labels_[p] == 0) return record;
    if (settings_.parameters.boundary) add_border(p, record);
    if (settings_.parameters.fold) add_contacts(p, record);
    return record;
  }

 private:
  static constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();

  double d2(std::size_t p, std::size_t q) const {
    return static_cast<double>(squared_distance(tile_.positions[p], tile_.positions[q]));
  }

  /// Nearest point of a supervoxel.
  std::size_t nearest(std::size_t p, std::uint32_t label) const {
    std::size_t best = kNobody;
    for (std::size_t q = 0; q < labels_.size(); ++q) {
      if (labels_[q] != label) continue;
      if (best == kNobody || d2(p, q) < d2(p, best) || (d2(p, q) == d2(p, best) && tile_.ids[q] < tile_.ids[best])) {
        best = q;
      }
    }
    return best;
  }

  void add_border(std::size_t p, ContourRecord& record) {
    const SupervoxelFrame frame = supervoxel_frame(table_, labels_[p]);
    const double alpha = settings_.typical.alpha;
    PlaneNeighbours neighbours;
    for (std::size_t q = 0; q < labels_.size(); ++q) {
      if (labels_[q] == labels_[p]) {
        Vector3 d;
        for (int axis = 0; axis < 3; ++axis) {
          d[static_cast<std::size_t>(axis)] =
              static_cast<double>(std::int64_t{tile_.positions[q][axis]} - tile_.positions[p][axis]);
        }
        const double a = dot(frame.u, d), b = dot(frame.v, d), w = dot(frame.n, d);
        if (!(a * a + b * b + w * w < 4.0 * alpha * alpha)) continue;
        neighbours.a.push_back(a * (1.0 / (2.0 * alpha)));
        neighbours.b.push_back(b * (1.0 / (2.0 * alpha)));
        ++neighbours.count;
      } else if (labels_[q] != 0 && table_.adjacent(labels_[p], labels_[q])) {
        if (d2(p, q) <= settings_.typical.seam * settings_.typical.seam) return;
      }
    }
    const double free_deg = frame.defined ? AlphaExposure().without_rejection(neighbours) : 360.0;
    if (free_deg == 0.0) return;
    record.classes |= kBoundary;
    record.gap_deg = static_cast<float>(free_deg);
    record.score = std::max(record.score, border_score(free_deg, settings_.typical));
  }

  void add_contacts(std::size_t p, ContourRecord& record) {
    for (std::uint32_t label = 1; label < table_.size(); ++label) {
      if (label == labels_[p] || !table_.adjacent(labels_[p], label)) continue;
      const double angle_deg = normal_angle_deg(table_, labels_[p], label);
      const std::size_t q = nearest(p, label);
      if (angle_deg <= settings_.parameters.angle_deg || q == kNobody || nearest(q, labels_[p]) != p) continue;
      if (d2(p, q) > settings_.typical.cap * settings_.typical.cap) continue;
      Vector3 contact;
      for (int axis = 0; axis < 3; ++axis) {
        contact[static_cast<std::size_t>(axis)] =
            0.5 * (static_cast<double>(tile_.positions[p][axis]) + tile_.positions[q][axis]);
      }
      ContourRecord one;
      one.classes = kSupervoxelContact | kFold;
      one.votes = 1;
      one.fold_strength = static_cast<float>(angle_deg / settings_.parameters.angle_deg);
      one.fold_angle_deg = static_cast<float>(interior_angle_deg(table_, labels_[p], label, contact));
      one.score = contact_score(std::sqrt(d2(p, q)), angle_deg, settings_);
      combine(record, one);
    }
  }

  const TilePoints& tile_;
  std::span<const std::uint32_t> labels_;
  const SupervoxelTable& table_;
  const ZhengSettings& settings_;
};

}  // namespace

TileContours reference_zheng(const TilePoints& tile, std::span<const std::uint32_t> labels,
                             const SupervoxelTable& table, const Lattice& lattice, const ZhengParameters& parameters) {
  const ZhengSettings settings(parameters, lattice);
  Reference reference(tile, labels, table, settings);
  TileContours contours;
  ContourRecords at(tile.positions.size());
  for (std::size_t p = 0; p < at.size(); ++p) {
    if (tile.core.contains(tile.positions[p])) at[p] = reference.record(p);
    at[p].id = tile.ids[p];
    if (at[p].classes != 0) contours.records.push_back(at[p]);
  }
  for (const auto& [id, entry] : tile.duplicates) {
    if (at[entry].classes == 0) continue;
    contours.records.push_back(at[entry]);
    contours.records.back().id = id;
  }
  std::sort(contours.records.begin(), contours.records.end(),
            [](const ContourRecord& a, const ContourRecord& b) { return a.id < b.id; });
  return contours;
}

}  // namespace arris::test
