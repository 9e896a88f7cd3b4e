#include "segment_options.h"

#include <CLI/CLI.hpp>

#include "run_options.h"

namespace arris::tools {

void add_segment_options(CLI::App& verb, SegmentOptions& o) {
  const char* const group = "Region growing";
  SegmentParameters& p = o.parameters;
  const auto number = [&](const char* name, auto& value, const char* what) {
    verb.add_option(name, value, what)->group(group)->capture_default_str();
  };
  const auto length = [&](const char* name, std::string& value, const char* what) {
    verb.add_option(name, value, what)->group(group);
  };
  verb.add_option(
          "-k,--neighbours", p.neighbours,
          "Nearest neighbours of a point, 3 to 64 (default 8, and up to 32 where points are closer to each other "
          "than the noise of the scan allows or lie along scan lines)")
      ->group(group);
  length("--radius", o.radius, "All points this near are neighbours, 64 at most, instead of the nearest (length)");
  length("--max-radius", o.max_radius, "Neighbours are never farther (length; default: 120 spacings of the scan)");
  number("--angle", p.angle_deg, "Normals of neighbours in one segment differ by less, degrees");
  verb.add_option(
          "--intensity-step", p.intensity_step,
          "Intensities of neighbours in one segment, scaled to 0 to 255, differ by less; at least 1 (default 20 for "
          "intensities smoothed over the neighbours; as published 10, not smoothed)")
      ->group(group);
  number("--curvature", p.curvature,
         "Segments grow from points with a smaller surface variation, above 0 to 1 (it is at most 1/3)");
  verb.add_option(
          "--agreement", p.agreement,
          "Segments grow from a point only if at least this share of its neighbours, 0 to 1, has a normal and an "
          "intensity like its own (default 0.3; not with --as-published)")
      ->group(group);
  number("--min-points", p.min_points, "Segments of fewer points are dropped (SegmentId 0); at least 1");
  length("--inlier-distance", o.inlier_distance,
         "Farther from its plane a neighbour has less weight (length; default: from the residuals)");
  verb.add_option("--sweeps", p.sweeps,
                  "Times that points near borders are given to the nearest plane 0 to 10 (default 4, as published 2)")
      ->group(group);
  length("--reassign-distance", o.reassign_distance,
         "A plane takes points near the borders of segments only if they are this near to it (length; default: 3 times "
         "its RMS, but 0.15 to 0.35 spacings of the segment)");
  verb.add_flag(
          "--as-published", p.published,
          "Without what arris adds: sharper weights, smoothed intensities, --agreement, and points that change segment "
          "at borders; changes the defaults of --sweeps and --intensity-step")
      ->group(group);
  const char* const shape_group = "Contours and outlines";
  verb.add_flag(
          "--contours", o.contours,
          "Add EdgeClass, EdgeScore and FoldAngle: where segments end, and where two of them meet (convex and concave "
          "as seen from above)")
      ->group(shape_group);
  verb.add_option("--alpha-factor", o.shape.alpha_factor,
                  "Radius of the alpha shape whose border is the outline, in spacings of the segment, 1 to 100")
      ->group(shape_group)
      ->capture_default_str();
  verb.add_option("--fold-angle", o.shape.fold_angle_deg,
                  "Planes whose normals differ by less make no fold, degrees, between 0 and 90")
      ->group(shape_group)
      ->capture_default_str();
}

SegmentParameters to_parameters(const SegmentOptions& o) {
  SegmentParameters p = o.parameters;
  p.radius = length_or(o.radius, 0.0);
  p.max_radius = length_or(o.max_radius, 0.0);
  p.inlier_distance = length_or(o.inlier_distance, 0.0);
  p.reassign_distance = length_or(o.reassign_distance, 0.0);
  return p;
}

}  // namespace arris::tools
