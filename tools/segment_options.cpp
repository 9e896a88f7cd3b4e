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
  number("-k,--neighbours", p.neighbours, "Nearest neighbours of a point, 3 to 64");
  length("--radius", o.radius, "All points this near are neighbours, 64 at most, instead of the nearest (length)");
  length("--max-radius", o.max_radius, "Neighbours are never farther (length; default: 120 spacings)");
  number("--angle", p.angle_deg, "Normals of neighbours in one segment differ by less, degrees");
  verb.add_option("--intensity-step", p.intensity_step,
                  "Their intensities, brought to 0 to 255, differ by less (default 20, as published 10)")
      ->group(group);
  number("--curvature", p.curvature, "Segments grow from points with a smaller surface variation");
  number("--agreement", p.agreement, "Segments grow from points that this share of the neighbours is like; 0 to 1");
  number("--min-points", p.min_points, "Smaller segments are none");
  length("--inlier-distance", o.inlier_distance,
         "Farther from its plane a neighbour has less weight (length; default: from the residuals)");
  verb.add_option("--sweeps", p.sweeps,
                  "Times that points near borders are given to the nearest plane (default 4, as published 2)")
      ->group(group);
  length("--reassign-distance", o.reassign_distance,
         "Only if they are this near to it (length; default: 3 times its RMS)");
  verb.add_flag("--as-published", p.published,
                "Without what arris adds: growth from consistent surroundings, borders drawn by planes")
      ->group(group);
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
