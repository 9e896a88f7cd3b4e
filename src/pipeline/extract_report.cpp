#include "pipeline/extract_report.h"

#include <nlohmann/json.hpp>

#include "pipeline/supervoxel.h"

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

Json zheng_json(const ContourParameters& parameters) {
  const ZhengParameters& p = parameters.zheng;
  return {{"spacing", p.spacing},
          {"angle_deg", p.angle_deg},
          {"contact_cap", p.contact_cap},
          {"contact_factor", p.contact_factor},
          {"alpha", p.alpha},
          {"alpha_factor", p.alpha_factor},
          {"seam_distance", p.seam_distance},
          {"seam_factor", p.seam_factor},
          {"improved", p.improved},
          {"boundary", p.boundary},
          {"fold", p.fold},
          {"supervoxel", supervoxel_json(parameters.supervoxel)}};
}

Json parameters_json(const ContourParameters& p) {
  switch (p.method) {
    case ContourParameters::Method::kArris:
      return arris_json(p.arris);
    case ContourParameters::Method::kLiu:
      return liu_json(p.liu);
    case ContourParameters::Method::kZheng:
      return zheng_json(p);
  }
  return {};
}

}  // namespace

Json to_json(const ExtractReport& r) {
  Json json = report_head(r, "arris-extract-report/1");
  json["method"] = r.parameters.name();
  json["parameters"] = parameters_json(r.parameters);
  json["points"] = {
      {"in", r.points_in}, {"out", r.points_out}, {"not_contour", r.not_contour}, {"dropped", dropped_json(r)}};
  json["edges"] = {{"boundary", r.boundary},
                   {"weak_boundary", r.weak_boundary},
                   {"fold", r.fold},
                   {"contact", r.contact},
                   {"isolated_points", r.isolated}};
  if (r.parameters.by_supervoxels())
    json["supervoxels"] = {{"voxels", r.voxels}, {"count", r.supervoxels}, {"tiles", r.voxel_tiles}};
  json["tiles"] = tiles_json(r);
  append_report_tail(json, r);
  return json;
}

}  // namespace arris::pipeline
