#include "pipeline/extract_report.h"

#include <nlohmann/json.hpp>

#include "core/version.h"
#include "pipeline/libraries.h"

namespace arris::pipeline {
namespace {

using Json = nlohmann::ordered_json;

Json liu_json(const LiuParameters& p) {
  return {{"k_min", p.k_min},
          {"k_max", p.k_max},
          {"k_step", p.k_step},
          {"covariance_with_target", p.covariance_with_target},
          {"min_planarity", p.min_planarity},
          {"gap_deg", p.gap_deg},
          {"far_factor", p.far_factor},
          {"far_distance", p.far_distance},
          {"span", p.span == LiuParameters::Span::kBracket ? "bracket" : "inner"},
          {"radius_factor", p.radius_factor},
          {"radius", p.radius},
          {"cf1_factor", p.cf1_factor},
          {"cf1", p.cf1},
          {"fold_angle_deg", p.fold_angle_deg},
          {"noise", p.noise},
          {"cf2", p.cf2},
          {"top_m", p.top_m},
          {"emit", p.emit == LiuParameters::Emit::kEmit ? "emit" : "self"},
          {"min_votes", p.min_votes},
          {"spacing", p.spacing},
          {"max_radius", p.max_radius},
          {"boundary", p.boundary},
          {"fold", p.fold}};
}

Json arris_json(const ArrisParameters& p) {
  Json view = "none";
  if (p.view == ArrisParameters::View::kAbove) view = "above";
  if (p.view == ArrisParameters::View::kPoint) view = p.viewpoint;
  return {{"spacing", p.spacing},     {"max_radius", p.max_radius},
          {"min_score", p.min_score}, {"boundary", p.boundary},
          {"fold", p.fold},           {"thin", p.thin},
          {"viewpoint", view}};
}

Json parameters_json(const ContourParameters& p) {
  return p.method == ContourParameters::Method::kArris ? arris_json(p.arris) : liu_json(p.liu);
}

}  // namespace

Json to_json(const ExtractReport& r) {
  Json json;
  json["schema"] = "arris-extract-report/1";
  json["arris"] = kVersion;
  json["libraries"] = pipeline::library_versions();
  json["method"] = r.parameters.name();
  json["parameters"] = parameters_json(r.parameters);
  json["lattice"] = {{"step", r.lattice.step}, {"origin", r.lattice.origin}};
  json["spacing"] = r.spacing;
  for (const InputReport& input : r.inputs) {
    Json entry{{"path", input.path}, {"layout", input.layout}, {"points", input.points}, {"bytes", input.size_bytes}};
    if (!input.hash.empty()) entry["xxh3_64"] = input.hash;
    json["inputs"].push_back(entry);
  }
  json["outputs"] = r.outputs;
  json["points"] = {{"in", r.points_in},
                    {"out", r.points_out},
                    {"not_contour", r.not_contour},
                    {"dropped",
                     {{"non_finite", r.dropped_nonfinite},
                      {"out_of_range", r.dropped_out_of_range},
                      {"excluded", r.dropped_excluded}}}};
  json["edges"] = {
      {"boundary", r.boundary}, {"weak_boundary", r.weak_boundary}, {"fold", r.fold}, {"isolated_points", r.isolated}};
  json["tiles"] = {{"count", r.tiles},
                   {"largest_points", r.largest_tile_points},
                   {"points_limit", r.tile_points_limit},
                   {"in_flight", r.tile_workers},
                   {"halo", {{"least", r.least_halo}, {"widest", r.widest_halo}}},
                   {"duplication", r.duplication},
                   {"widened_queries", r.widened_queries}};
  json["threads"] = r.threads;
  json["memory"] = {{"budget_bytes", r.memory_budget_bytes},
                    {"predicted_peak_bytes", r.predicted_peak_bytes},
                    {"measured_peak_bytes", r.peak_resident_bytes}};
  json["temp"] = {{"predicted_bytes", r.predicted_temp_bytes}, {"measured_peak_bytes", r.peak_temp_bytes}};
  for (const auto& [phase, seconds] : r.seconds) json["seconds"][phase] = seconds;
  json["cpu_seconds"] = r.cpu_seconds;
  json["warnings"] = Json::array();
  for (const WarningReport& w : r.warnings) json["warnings"].push_back({{"code", w.code}, {"text", w.text}});
  return json;
}

}  // namespace arris::pipeline
