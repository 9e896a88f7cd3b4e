/// @file bench_score_samples SCAN TRUTH.csv: the evidence for every contour that the limits of arris's own method let
/// pass, as CSV on stdout, with the distance of its point to the truth: what fit_score.py fits EdgeScore to. Distances
/// are in the spacing of the nearest edge. One thread; the whole scan in memory.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "candidate.h"
#include "core/error.h"
#include "core/parallel.h"
#include "evaluate/edge_index.h"
#include "evaluate/truth.h"
#include "features/arris/arris_method.h"
#include "io/point_source.h"
#include "tiling/tile_store.h"

namespace {

constexpr std::size_t kMostSamples = 1 << 24;        // Records number the samples as float.
constexpr double kFarthest = 50.0;                   // Distances are cut here.
constexpr double kMaxRadiusInSceneSpacings = 100.0;  // Plenty: the largest ball has 13 of the local spacing.

struct Scan {
  arris::TilePoints tile;
  arris::Lattice lattice;
  std::vector<arris::evaluate::Vec3> positions;  ///< By id.
};

Scan read_scan(const std::string& path) {
  const auto source = arris::io::open_point_source(path);
  const auto& info = source->info();
  if (!info.scaled_integers) throw arris::InputError(path + ": is no LAS file, whose scale the lattice is made of");
  Scan scan;
  scan.lattice = {info.scale[0], info.offset};
  arris::LatticePoints positions;
  arris::PointIds ids;
  arris::io::PointBatch batch;
  while (source->read(batch, {})) {
    for (std::size_t i = 0; i < batch.count; ++i) {
      double p[3];
      std::int32_t q[3];
      for (int axis = 0; axis < 3; ++axis) {
        p[axis] = arris::io::world_coordinate(info, batch, i, axis);
        q[axis] = static_cast<std::int32_t>(scan.lattice.index(axis, p[axis]));
      }
      ids.push_back(scan.positions.size());
      positions.push_back({q[0], q[1], q[2]});
      scan.positions.push_back({p[0], p[1], p[2]});
    }
  }
  constexpr std::int64_t kAll = std::int64_t{1} << 40;
  scan.tile.covered = {{-kAll, -kAll, -kAll}, {kAll, kAll, kAll}};
  scan.tile.core = scan.tile.covered;
  arris::tiling::fold_duplicates(std::move(positions), std::move(ids), scan.tile);
  return scan;
}

/// Factor of the scene's spacing at a place, 1 but for the sampling "gradient" (synth/scene.h) of scenes that are not
/// rotated: 1 to sqrt(10) along the x that the edges span.
class SpacingGradient {
 public:
  explicit SpacingGradient(const arris::evaluate::Truth& truth) {
    const auto sampling = truth.properties.find("sampling");
    if (sampling == truth.properties.end() || sampling->second != "gradient") return;
    if (truth.number("rotate", 1.0) != 0.0) throw arris::InputError("a gradient scene must not be rotated");
    for (const auto& edge : truth.edges) {
      for (int i = 0; i <= 64; ++i) {
        const double x = edge.point_at(i / 64.0).x;
        min_ = std::min(min_, x);
        max_ = std::max(max_, x);
      }
    }
  }
  double at(const arris::evaluate::Vec3& p) const {
    if (!(max_ > min_)) return 1.0;
    return 1.0 + (std::sqrt(10.0) - 1.0) * std::clamp((p.x - min_) / (max_ - min_), 0.0, 1.0);
  }

 private:
  double min_ = std::numeric_limits<double>::infinity(), max_ = -std::numeric_limits<double>::infinity();
};

std::string row_of(const arris::bench::Candidate& c) {
  const arris::FoldEvidence& f = c.fold;
  const arris::RimEvidence& r = c.rim;
  return fmt::format(
      "{:d},{:d},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{},{},{},{},{},{:.6g},"
      "{:.6g},{:.6g},{:.6g},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}",
      c.has_fold, c.has_rim, f.ball_radius, f.line_spacing, f.distance, f.position_error, f.angle_deg, f.rms, f.all_rms,
      f.curved_rms, f.count_a, f.count_b, f.all_count, f.support_a, f.support_b, arris::fold_score(f), r.gap_deg,
      r.depth, r.empty_radius, r.count, r.inner_share, r.offset, r.gate, r.rms, r.width, r.noise, arris::rim_score(r));
}

constexpr const char* kColumns =
    "id,to_edge,edge_spacing,fold,rim,f_ball,f_line_spacing,f_distance,f_position_error,f_angle_deg,f_rms,f_all_rms,"
    "f_curved_rms,f_count_a,f_count_b,f_all_count,f_support_a,f_support_b,f_score,r_gap_deg,r_depth,"
    "r_empty_radius,r_count,r_inner_share,r_offset,r_gate,r_rms,r_width,r_noise,r_score";

void run(const std::string& scan_path, const std::string& truth_path) {
  const arris::ThreadLimit one_thread(1);
  const arris::evaluate::Truth truth = arris::evaluate::read_truth_csv(std::filesystem::path(truth_path));
  const double spacing = truth.number("spacing", 0.0);
  if (!(spacing > 0.0)) throw arris::InputError(truth_path + ": has no spacing");
  std::vector<double> units;
  for (const auto& edge : truth.edges) units.push_back(edge.spacing > 0.0 ? edge.spacing : spacing);
  const arris::evaluate::EdgeIndex edges(truth.edges, units);

  const SpacingGradient gradient(truth);
  const Scan scan = read_scan(scan_path);
  arris::ArrisParameters parameters;
  parameters.min_score = 0.0;
  parameters.max_radius = kMaxRadiusInSceneSpacings * spacing;
  const arris::TileContours contours = arris::extract_arris(scan.tile, scan.lattice, parameters);
  const auto& candidates = arris::bench::met_candidates();
  if (candidates.size() > kMostSamples) throw arris::InputError("more than 2^24 candidates: take a smaller scan");
  fmt::print("{}\n", kColumns);
  for (const arris::ContourRecord& record : contours.records) {
    const auto nearest = edges.nearest(scan.positions[record.id], kFarthest);
    const double factor = gradient.at(scan.positions[record.id]);
    const double distance = std::min(nearest.distance, kFarthest) / factor;
    fmt::print("{},{:.4f},{:.5g},{}\n", record.id, distance,
               factor * (nearest.distance < kFarthest ? units[nearest.edge] : spacing),
               row_of(candidates[static_cast<std::size_t>(record.score) - 1]));
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Samples for the calibration of EdgeScore");
  std::string scan;
  std::string truth;
  app.add_option("scan", scan, "LAS, as arris synth makes it")->required();
  app.add_option("truth", truth, "Its truth")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    run(scan, truth);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_score_samples: {}\n", error.what());
    return 1;
  }
  return 0;
}
