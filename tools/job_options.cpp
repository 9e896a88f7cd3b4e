#include "job_options.h"

#include <CLI/CLI.hpp>
#include <charconv>

#include "core/error.h"
#include "core/text.h"
#include "core/units.h"

namespace arris::tools {
namespace {

void add_liu_options(CLI::App& verb, JobOptions& o) {
  const char* group = "Method liu: neighbourhood";
  verb.add_option("--k-min", o.liu.k_min, "Fewest neighbours tried (eq. 6)")->group(group)->capture_default_str();
  verb.add_option("--k-max", o.liu.k_max, "Most neighbours tried (eq. 6)")->group(group)->capture_default_str();
  verb.add_option("--k-step", o.liu.k_step, "Step between them")->group(group)->capture_default_str();
  verb.add_flag("--neighbours-only", o.neighbours_only,
                "Covariance over the neighbours without the point itself (eq. 1, literal)")
      ->group(group);
  verb.add_option("--min-planarity", o.liu.min_planarity,
                  "Reject a k whose second eigenvalue is below this share of the first")
      ->group(group)
      ->capture_default_str();
  group = "Method liu: boundary";
  verb.add_option("--alpha", o.liu.gap_deg, "Azimuth gap that makes a boundary, degrees (eq. 10)")
      ->group(group)
      ->capture_default_str();
  verb.add_option("--far-factor", o.liu.far_factor,
                  "Second layer: neighbours farther than this many spacings are ignored (eq. 11)")
      ->group(group)
      ->capture_default_str();
  verb.add_option("--far-distance", o.far_distance, "The same as a length (d_thr)")->group(group);
  verb.add_option("--span", o.span, "Reading of the span in eq. 11")
      ->check(CLI::IsMember({"bracket", "inner"}))
      ->group(group)
      ->capture_default_str();
  verb.add_flag("--literal", o.literal, "The paper to the letter: --alpha 90 and --neighbours-only")->group(group);
  group = "Method liu: fold";
  verb.add_option("--radius-factor", o.liu.radius_factor, "Ball radius in local spacings (eq. 12)")
      ->group(group)
      ->capture_default_str();
  verb.add_option("--radius", o.radius, "Ball radius as a length, the same everywhere")->group(group);
  verb.add_option("--cf1-factor", o.liu.cf1_factor,
                  "Threshold of the distances' deviation in local spacings (eq. 21, 23)")
      ->group(group)
      ->capture_default_str();
  verb.add_option("--cf1", o.cf1, "The same as a length, the same everywhere")->group(group);
  verb.add_option("--fold-angle", o.liu.fold_angle_deg,
                  "Sets --cf1 so that folds up to this interior angle pass, degrees")
      ->group(group);
  verb.add_option("--noise", o.noise, "Standard deviation of the scanner's noise (length), for --fold-angle")
      ->group(group);
  verb.add_option("--cf2", o.liu.cf2, "Threshold of the ratio of points on both sides (eq. 22, 23)")
      ->group(group)
      ->capture_default_str();
  verb.add_option("--top-m", o.liu.top_m, "Points that a ball emits (eq. 24)")->group(group)->capture_default_str();
  verb.add_option("--emit", o.emit, "emit: every ball emits its top m; self: only its centre if among them")
      ->check(CLI::IsMember({"emit", "self"}))
      ->group(group)
      ->capture_default_str();
  verb.add_option("--min-votes", o.liu.min_votes, "Fold points emitted by fewer balls are dropped")
      ->group(group)
      ->capture_default_str();
}

void add_zheng_options(CLI::App& verb, JobOptions& o) {
  const char* group = "Method zheng: contours";
  verb.add_flag("--improved", o.zheng.improved, "Beyond the paper: steps, local spacing, seams healed")->group(group);
  verb.add_option("--plane-angle", o.zheng.angle_deg,
                  "Supervoxels whose normals are further apart are not coplanar, degrees (2.2)")
      ->group(group)
      ->capture_default_str();
  verb.add_option("--contact-cap", o.contact_cap, "Mutual nearest neighbours are no further apart (length; 3 spacings)")
      ->group(group);
  verb.add_option("--alpha-radius", o.alpha_radius, "Radius of the alpha shape (length; 2 spacings)")->group(group);
  verb.add_option("--seam-distance", o.seam_distance,
                  "Border points this near to an adjacent supervoxel are seams (length; 1.8 spacings)")
      ->group(group);
  add_supervoxel_options(verb, o.supervoxel, "Method zheng: supervoxels");
}

void add_contour_options(CLI::App& verb, JobOptions& o) {
  const char* group = "Contours";
  verb.add_option("--method", o.method,
                  "arris: the default, nothing to set; liu: Liu et al.; zheng: Zheng et al., by supervoxels")
      ->check(CLI::IsMember({"arris", "liu", "zheng"}))
      ->group(group)
      ->capture_default_str();
  verb.add_option("--spacing", o.spacing, "One point spacing for all points (length); estimated per point if not given")
      ->group(group);
  verb.add_option("--max-radius", o.max_radius,
                  "Neighbours beyond are not neighbours (length); chosen from the scan if not given")
      ->group(group);
  verb.add_flag("--no-boundary", o.no_boundary, "Skip the boundary tests")->group(group);
  verb.add_flag("--no-fold", o.no_fold, "Skip the fold tests")->group(group);
  group = "Method arris";
  verb.add_option("--precision", o.precision,
                  "Keep points whose EdgeScore is at least this: the probability that an edge is there (default 0.3)")
      ->check(CLI::Range(0.0, 1.0))
      ->group(group);
  verb.add_flag("--thin", o.thin, "Keep one chain of points along each contour")->group(group);
  verb.add_option("--viewpoint", o.viewpoint,
                  "From where convex and concave are told apart: above, none, or X,Y,Z of the scanner")
      ->group(group)
      ->capture_default_str();
}

/// "above", "none" or three coordinates.
void parse_viewpoint(const std::string& text, ArrisParameters& arris) {
  using View = ArrisParameters::View;
  arris.view = text == "none" ? View::kNone : text == "above" ? View::kAbove : View::kPoint;
  if (arris.view != View::kPoint) return;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (int axis = 0; axis < 3; ++axis) {
    const auto [next, error] = std::from_chars(at, end, arris.viewpoint[axis]);
    const bool last = axis == 2;
    if (error != std::errc{} || (last ? next != end : next == end || *next != ',')) {
      throw ConfigError("--viewpoint '" + printable(text, 60) + "' is neither above, none nor X,Y,Z");
    }
    at = next + 1;
  }
}

/// An option of another method has no effect: better an error than a surprise.
void refuse_foreign_options(const std::string& method, const CLI::App& verb) {
  for (const CLI::Option* option : verb.get_options()) {
    const bool foreign =
        option->get_group().rfind("Method ", 0) == 0 && option->get_group().rfind("Method " + method, 0) != 0;
    if (foreign && option->count() > 0) {
      throw ConfigError(option->get_name() + " belongs to another method than " + method + "; see --method");
    }
  }
  if (method == "zheng" && verb.count("--max-radius") > 0)
    throw ConfigError("--max-radius has no effect on method zheng; see --contact-cap and --alpha-radius");
}

}  // namespace

void add_job_options(CLI::App& verb, JobOptions& o) {
  add_run_options(verb, o.run);
  add_contour_options(verb, o);
  add_liu_options(verb, o);
  add_zheng_options(verb, o);
}

pipeline::ExtractRequest to_request(JobOptions& o, const CLI::App& verb) {
  pipeline::ExtractRequest request;
  fill_run_request(o.run, request);

  request.method.method = o.method == "liu"     ? ContourParameters::Method::kLiu
                          : o.method == "zheng" ? ContourParameters::Method::kZheng
                                                : ContourParameters::Method::kArris;
  ArrisParameters& arris = request.method.arris;
  arris.spacing = length_or(o.spacing, 0.0);
  arris.max_radius = length_or(o.max_radius, 0.0);
  if (o.precision >= 0.0) arris.min_score = o.precision;
  arris.boundary = !o.no_boundary;
  arris.fold = !o.no_fold;
  arris.thin = o.thin;
  parse_viewpoint(o.viewpoint, arris);
  refuse_foreign_options(o.method, verb);
  LiuParameters& liu = request.method.liu;
  liu = o.liu;
  if (o.literal && verb.count("--alpha") == 0) liu.gap_deg = 90.0;
  liu.covariance_with_target = !(o.neighbours_only || o.literal);
  liu.span = o.span == "inner" ? LiuParameters::Span::kInner : LiuParameters::Span::kBracket;
  liu.emit = o.emit == "self" ? LiuParameters::Emit::kSelf : LiuParameters::Emit::kEmit;
  liu.radius = length_or(o.radius, 0.0);
  liu.cf1 = length_or(o.cf1, 0.0);
  liu.far_distance = length_or(o.far_distance, 0.0);
  liu.spacing = length_or(o.spacing, 0.0);
  liu.max_radius = length_or(o.max_radius, 0.0);
  liu.noise = length_or(o.noise, 0.0);
  liu.boundary = !o.no_boundary;
  liu.fold = !o.no_fold;
  ZhengParameters& zheng = request.method.zheng;
  zheng = o.zheng;
  zheng.spacing = length_or(o.spacing, 0.0);
  zheng.contact_cap = length_or(o.contact_cap, 0.0);
  zheng.alpha = length_or(o.alpha_radius, 0.0);
  zheng.seam_distance = length_or(o.seam_distance, 0.0);
  zheng.boundary = !o.no_boundary;
  zheng.fold = !o.no_fold;
  request.method.supervoxel = to_parameters(o.supervoxel);
  return request;
}

}  // namespace arris::tools
