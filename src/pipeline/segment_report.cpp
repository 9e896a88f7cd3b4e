#include <nlohmann/json.hpp>

#include "pipeline/segment.h"

namespace arris::pipeline {

nlohmann::ordered_json segment_json(const SegmentParameters& p) {
  nlohmann::ordered_json json;
  if (p.radius > 0.0) {
    json["radius"] = p.radius;
  } else {
    json["neighbours"] = p.neighbours.value_or(kFewestNeighbours);
  }
  if (p.adaptive()) {
    json["most_neighbours"] = p.most_by_noise;
    json["noise"] = p.noise;
  }
  json["max_radius"] = p.max_radius;
  json["inlier_distance"] = p.inlier_distance;
  json["angle_deg"] = p.angle_deg;
  json["intensity"] = p.intensity;
  json["intensity_step"] = p.least_intensity_step();
  json["curvature"] = p.curvature;
  json["agreement"] = p.least_agreement();
  json["min_points"] = p.min_points;
  json["sweeps"] = p.sweep_count();
  json["reassign_distance"] = p.reassign_distance;
  json["as_published"] = p.published;
  return json;
}

nlohmann::ordered_json to_json(const SegmentReport& r) {
  nlohmann::ordered_json json = report_head(r, "arris-segment-report/1");
  json["parameters"] = segment_json(r.parameters);
  json["min_height"] = r.min_height ? nlohmann::ordered_json(*r.min_height) : nlohmann::ordered_json();
  json["intensities"] = nlohmann::ordered_json::array();
  for (const IntensityRange& range : r.intensities) {
    json["intensities"].push_back(
        {{"scaled", range.scale.scaled}, {"low", range.scale.low}, {"high", range.scale.high}});
  }
  json["points"] = {{"in", r.points_in},         {"out", r.points_out},    {"dropped", dropped_json(r)},
                    {"labelled", r.labelled},    {"isolated", r.isolated}, {"frontier", r.frontier},
                    {"reassigned", r.reassigned}};
  json["segments"] = r.segments;
  json["contour_parameters"] = {{"alpha_factor", r.shape.alpha_factor},
                                {"fold_angle_deg", r.shape.fold_angle_deg},
                                {"most_spacing", r.shape.most_spacing}};
  json["contours"] = {{"boundary", r.boundary}, {"fold", r.fold}};
  json["tiles"] = tiles_json(r);
  append_report_tail(json, r);
  return json;
}

}  // namespace arris::pipeline
