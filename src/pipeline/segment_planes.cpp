#include "pipeline/segment_planes.h"

#include <cmath>

#include "core/error.h"
#include "merge/group_numbers.h"
#include "merge/segment_reassignment.h"
#include "tiling/mapped_pass.h"

namespace arris::pipeline {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// In the order of ids, so that every segment's origin is its first point.
merge::SegmentMoments sum_moments(io::InputSet& inputs, const Lattice& lattice, const merge::GrownSegments& grown,
                                  ProgressSink& progress, const CancelToken& cancel) {
  merge::SegmentMoments moments(static_cast<std::uint32_t>(grown.discs.size()));
  tiling::for_each_mapped_batch(inputs, lattice, "planes", progress, cancel, [&](const tiling::MappedPoints& points) {
    for (std::size_t i = 0; i < points.positions.size(); ++i) {
      const std::uint32_t label = grown.labels[points.batch.first_id + i];
      if (label == 0) continue;
      if (points.outcome[i] != tiling::Mapped::kOk)
        throw InputError("the inputs changed while they were read; run again when they are complete");
      moments.add(label, points.positions[i]);
    }
  });
  return moments;
}

/// Segments of min_points and more, in the order of their smallest ids.
void number(std::uint32_t min_points, PlanarSegments& segments, const merge::SegmentMoments& moments) {
  std::vector<std::uint32_t> group_of(moments.count());
  for (std::uint32_t segment = 1; segment <= moments.count(); ++segment)
    group_of[segment - 1] = moments.points(segment) < min_points ? 0 : segment;
  std::vector<SegmentPlane> planes;
  for (const std::uint32_t segment : merge::number_groups(group_of, moments.count(), segments.labels)) {
    planes.push_back(segments.planes[segment - 1]);
    segments.points.push_back(moments.points(segment));
    segments.labelled += moments.points(segment);
  }
  segments.planes = std::move(planes);
}

}  // namespace

PlanarSegments settle_segments(io::InputSet& inputs, const PlaneSetup& setup, merge::GrownSegments grown,
                               const merge::SegmentFrontier& frontier, const merge::DuplicatePoints& duplicates,
                               ProgressSink& progress, const CancelToken& cancel) {
  merge::SegmentMoments moments = sum_moments(inputs, setup.lattice, grown, progress, cancel);
  PlanarSegments segments;
  segments.labels = std::move(grown.labels);
  for (std::uint32_t segment = 1; segment <= moments.count(); ++segment) {
    segments.planes.push_back(moments.plane(segment));
    // The discs are of different positions, the points count duplicates too: where there are many, s is too small,
    // which only draws the tolerances closer.
    const double area = kPi * static_cast<double>(grown.discs[segment - 1]);
    segments.planes.back().spacing = std::sqrt(area / static_cast<double>(moments.points(segment)));
  }
  progress.phase("reassignment", frontier.records() * static_cast<std::uint64_t>(setup.parameters.sweep_count()));
  for (int sweep = 0; sweep < setup.parameters.sweep_count(); ++sweep) {
    const std::uint64_t changed = merge::reassign({setup.parameters, setup.lattice.step, setup.folder}, frontier,
                                                  duplicates, segments.labels, moments, segments.planes, cancel);
    segments.reassigned += changed;
    progress.advance(frontier.records());
    if (changed == 0) break;
  }
  number(setup.parameters.min_points, segments, moments);
  return segments;
}

}  // namespace arris::pipeline
