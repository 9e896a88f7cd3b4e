#include "merge/segment_reassignment.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "features/numerics/exact_math.h"
#include "merge/frontier_walk.h"
#include "merge/segment_sides.h"

namespace arris::merge {
namespace {

struct Change {
  std::uint32_t id = 0;
  std::uint32_t segment = 0;
  LatticePoint position;
};

/// Decides for one point after the other; read only.
class Judge {
 public:
  Judge(const ReassignmentSetup& setup, const PointLabels& labels, const std::vector<SegmentPlane>& planes,
        const SegmentSides& sides)
      : published_(setup.parameters.published),
        labels_(labels),
        planes_(planes),
        sides_(sides),
        limit_(planes.size()),
        least_alignment_(cosine(setup.parameters.angle_deg / kDegreesPerRadian)) {
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const double s = planes[i].spacing;
      limit_[i] = setup.parameters.reassign_distance > 0.0
                      ? setup.parameters.reassign_distance / setup.lattice_step
                      : std::min(std::max(kReassignRms * planes[i].rms, kLeastReassign * s), kMostReassign * s);
    }
  }

  /// The segment that the point should have.
  std::uint32_t decide(const FrontierPoint& point) const {
    const std::uint32_t own = labels_[point.id];
    if (own != 0 && (published_ || planes_[own - 1].rms > kMostPlanarRms * planes_[own - 1].spacing)) return own;
    std::uint32_t best = own;
    std::uint32_t passed_over = 0;  // For `best`; the next neighbour is often of the same segment.
    double at_best = own != 0 ? signed_distance(planes_[own - 1], point.position) : 0.0;
    for (const std::uint32_t neighbour : point.neighbours) {
      const std::uint32_t segment = labels_[neighbour];
      if (segment == 0 || segment == best || segment == passed_over) continue;
      const double d = signed_distance(planes_[segment - 1], point.position);
      if (!(std::fabs(d) > limit_[segment - 1]) && (best == 0 || is_nearer(segment, d, best, at_best))) {
        best = segment;
        at_best = d;
        passed_over = 0;
      } else {
        passed_over = segment;
      }
    }
    return best == own && own != 0 && is_stray(planes_[own - 1], at_best, limit_[own - 1]) ? 0 : best;
  }

 private:
  /// A point of a flat segment that the segment would not have been given.
  bool is_stray(const SegmentPlane& plane, double distance, double limit) const {
    if (published_ || !(plane.rms < kMostFlatRms * plane.spacing)) return false;
    return std::fabs(distance) > std::max(kStrayRms * plane.rms, limit);
  }

  /// Whether a point at signed distances d_a and d_b of two planes belongs to a rather than to b.
  bool is_nearer(std::uint32_t a, double d_a, std::uint32_t b, double d_b) const {
    const bool nearer = std::fabs(d_a) < std::fabs(d_b) || (std::fabs(d_a) == std::fabs(d_b) && a < b);
    if (published_ || std::fabs(d_b) > limit_[b - 1]) return nearer;
    // One plane in two segments (of different materials) says nothing: the point's own segment, or that of the nearer
    // neighbour, stays.
    if (std::fabs(dot(planes_[a - 1].normal, planes_[b - 1].normal)) > least_alignment_) return false;
    // Each segment ends where the planes meet. Of the two planes that halve the angle, only the one between the two
    // segments counts: the distances alone would also cut at the other, across the noise above a ridge.
    const int side_of_a = sides_.side(a, b), side_of_b = sides_.side(b, a);
    if (side_of_a == 0 || side_of_b == 0) return nearer;
    const double beyond_b = side_of_a * d_b, beyond_a = side_of_b * d_a;
    return beyond_b != beyond_a ? beyond_b > beyond_a : a < b;
  }

  bool published_;
  const PointLabels& labels_;
  const std::vector<SegmentPlane>& planes_;
  const SegmentSides& sides_;
  std::vector<double> limit_;  ///< Steps.
  double least_alignment_;
};

void learn_sides_of(const FrontierPoint& point, const PointLabels& labels, SegmentSides& sides) {
  const std::uint32_t own = labels[point.id];
  if (own == 0) return;
  std::uint32_t other = 0;
  std::int64_t run = 0;  // Neighbours in `other`, one after the other.
  const auto end_run = [&] {
    if (run > 0) sides.add(own, other, point.position, run);
    run = 0;
  };
  for (const std::uint32_t neighbour : point.neighbours) {
    const std::uint32_t segment = labels[neighbour];
    if (segment == 0 || segment == own) continue;
    if (segment != other) end_run();
    other = segment;
    ++run;
  }
  end_run();
}

/// Looks at the points of every segment that have neighbours in another.
void learn_sides(const SegmentFrontier& frontier, const PointLabels& labels, const std::vector<SegmentPlane>& planes,
                 SegmentSides& sides) {
  std::mutex mutex;  // Guards `sides`.
  frontier.for_each_blocks([&](std::span<const FrontierBlock> blocks) {
    parallel_for_chunks(blocks.size(), 1, [&](std::size_t block, std::size_t) {
      SegmentSides found(planes);
      for_each_point(blocks[block], labels,
                     [&](std::size_t, const FrontierPoint& point) { learn_sides_of(point, labels, found); });
      const std::lock_guard lock(mutex);
      sides.add(found);
    });
  });
}

void find_changes(const Judge& judge, const SegmentFrontier& frontier, const PointLabels& labels,
                  tiling::ScratchFile& changes, const CancelToken& cancel) {
  std::vector<std::vector<Change>> of_block;
  frontier.for_each_blocks([&](std::span<const FrontierBlock> blocks) {
    cancel.check();
    of_block.resize(blocks.size());
    parallel_for_chunks(blocks.size(), 1, [&](std::size_t block, std::size_t) {
      of_block[block].clear();
      for_each_point(blocks[block], labels, [&](std::size_t, const FrontierPoint& point) {
        const std::uint32_t decided = judge.decide(point);
        if (decided != labels[point.id]) of_block[block].push_back({point.id, decided, point.position});
      });
    });
    for (const std::vector<Change>& found : of_block) {
      if (!found.empty()) changes.append(std::as_bytes(std::span(found)));
    }
  });
}

class Updater {
 public:
  Updater(PointLabels& labels, SegmentMoments& moments) : labels_(labels), moments_(moments) {}

  void apply(std::uint32_t id, std::uint32_t segment, const LatticePoint& position) {
    std::uint32_t& label = labels_[id];
    if (label != 0) moments_.remove(label, position);
    if (segment != 0) moments_.add(segment, position);
    label = segment;
  }

 private:
  PointLabels& labels_;
  SegmentMoments& moments_;
};

}  // namespace

std::uint64_t reassign(const ReassignmentSetup& setup, const SegmentFrontier& frontier,
                       const DuplicatePoints& duplicates, PointLabels& labels, SegmentMoments& moments,
                       std::vector<SegmentPlane>& planes, const CancelToken& cancel) {
  tiling::ScratchFile changes(setup.folder / "segment_changes");
  SegmentSides sides(planes);
  if (!setup.parameters.published) learn_sides(frontier, labels, planes, sides);
  find_changes(Judge(setup, labels, planes, sides), frontier, labels, changes, cancel);
  const std::uint64_t count = changes.size_bytes() / sizeof(Change);
  Updater updater(labels, moments);
  std::vector<Change> block;
  constexpr std::uint64_t kBlock = 64 * 1024;
  for (std::uint64_t first = 0; first < count; first += kBlock) {
    block.resize(static_cast<std::size_t>(std::min(kBlock, count - first)));
    changes.read_at(first * sizeof(Change), std::as_writable_bytes(std::span(block)));
    for (const Change& change : block) updater.apply(change.id, change.segment, change.position);
  }
  if (count == 0) return 0;
  duplicates.for_each([&](const DuplicatePoint& point) {
    if (labels[point.id] != labels[point.of]) updater.apply(point.id, labels[point.of], point.position);
  });
  for (std::uint32_t segment = 1; segment <= planes.size(); ++segment) {
    const double spacing = planes[segment - 1].spacing;
    planes[segment - 1] = moments.plane(segment);
    planes[segment - 1].spacing = spacing;
  }
  return count;
}

}  // namespace arris::merge
