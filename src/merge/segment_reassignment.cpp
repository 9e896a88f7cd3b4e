#include "merge/segment_reassignment.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel.h"

namespace arris::merge {
namespace {

constexpr std::size_t kGrain = 4096;

struct Change {
  std::uint32_t id = 0;
  std::uint32_t segment = 0;
  LatticePoint position;
};

/// Decides for one point after the other; read only.
class Judge {
 public:
  Judge(const ReassignmentSetup& setup, const PointLabels& labels, const std::vector<SegmentPlane>& planes)
      : published_(setup.parameters.published), labels_(labels), planes_(planes), limit_(planes.size()) {
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
    if (own != 0 && published_) return own;
    std::uint32_t best = own;
    double least = own != 0 ? distance(own, point.position) : 0.0;
    for (const std::uint32_t neighbour : point.neighbours) {
      const std::uint32_t segment = labels_[neighbour];
      if (segment == 0 || segment == best) continue;
      const double d = distance(segment, point.position);
      if (d > limit_[segment - 1]) continue;
      if (best == 0 || d < least || (d == least && segment < best)) {
        best = segment;
        least = d;
      }
    }
    return best;
  }

 private:
  double distance(std::uint32_t segment, const LatticePoint& p) const {
    const SegmentPlane& plane = planes_[segment - 1];
    return std::fabs(plane.normal[0] * (p.x - plane.centroid[0]) + plane.normal[1] * (p.y - plane.centroid[1]) +
                     plane.normal[2] * (p.z - plane.centroid[2]));
  }

  bool published_;
  const PointLabels& labels_;
  const std::vector<SegmentPlane>& planes_;
  std::vector<double> limit_;  ///< Steps.
};

void find_changes(const Judge& judge, const SegmentFrontier& frontier, const PointLabels& labels,
                  tiling::ScratchFile& changes, const CancelToken& cancel) {
  std::vector<std::uint32_t> decided;
  std::vector<Change> block;
  frontier.for_each_block([&](std::span<const std::uint32_t> words) {
    cancel.check();
    decided.resize(words.size() / frontier.stride());
    parallel_for_chunks(decided.size(), kGrain, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) decided[i] = judge.decide(frontier.point(words, i));
    });
    block.clear();
    for (std::size_t i = 0; i < decided.size(); ++i) {
      const FrontierPoint point = frontier.point(words, i);
      if (decided[i] != labels[point.id]) block.push_back({point.id, decided[i], point.position});
    }
    if (!block.empty()) changes.append(std::as_bytes(std::span(block)));
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
  find_changes(Judge(setup, labels, planes), frontier, labels, changes, cancel);
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
