#include "pipeline/supervoxel.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "core/process_memory.h"
#include "pipeline/label_points.h"
#include "pipeline/point_selection.h"
#include "pipeline/run_folder.h"
#include "pipeline/run_support.h"
#include "pipeline/supervoxel_scene.h"
#include "pipeline/supervoxel_text.h"
#include "pipeline/voxel_estimate.h"
#include "pipeline/voxel_memory.h"

namespace arris::pipeline {
namespace {

struct SurveyedScan {
  tiling::Survey survey;
  SupervoxelScale scale;
  std::unique_ptr<ColourSource> colours;  ///< None: nullptr.
};

/// Pass 1, and what it tells of the work and its disk.
SurveyedScan survey_scan(io::InputSet& inputs, const SupervoxelRequest& request, ProblemWarnings& problems,
                         SupervoxelReport& report, ProgressSink& progress, const CancelToken& cancel) {
  SurveyedScan scan{tiling::survey_inputs(inputs, {request.lattice_step}, progress, cancel), {}, {}};
  problems.forward();
  refuse_missing_classes(request, scan.survey);
  describe_inputs(scan.survey, inputs, request, report);
  warn_of_dropped(report, progress);
  const double spacing = request.spacing > 0.0 ? request.spacing : scan.survey.spacing;
  scan.scale = resolve_scale(report.parameters, spacing, scan.survey.lattice);
  scan.colours = wanted_colours(inputs, report.parameters.colour, progress, cancel);
  report.predicted_temp_bytes = predicted_voxel_temp_bytes(scan.survey, scan.scale, report.parameters,
                                                           scan.colours != nullptr, VoxelMemory(request.memory_bytes));
  check_temp_space(report.predicted_temp_bytes, request, progress);
  return scan;
}

}  // namespace

SupervoxelReport plan_supervoxels(const SupervoxelRequest& request, ProgressSink& progress, const CancelToken& cancel) {
  SupervoxelReport report;
  report.parameters = request.parameters;
  validate(report.parameters);
  RecordingSink sink(progress, report);
  Stopwatch watch(report);
  const ThreadLimit limit(request.threads);
  io::InputSet inputs(io::expand_inputs(request.inputs), request.tolerance);
  ProblemWarnings problems(inputs, sink);
  problems.forward();
  inputs.exclude(request.exclusion);
  const SurveyedScan scan = survey_scan(inputs, request, problems, report, sink, cancel);
  watch.lap("survey");
  report.voxels = static_cast<std::uint64_t>(estimate_voxels(scan.survey, scan.scale).voxels);
  report.predicted_peak_bytes = std::max(
      peak_resident_bytes(), predicted_supervoxel_bytes(scan.survey, scan.scale, report.parameters,
                                                        scan.colours != nullptr, VoxelMemory(request.memory_bytes)));
  report.peak_resident_bytes = peak_resident_bytes();
  return report;
}

SupervoxelReport label_supervoxels(const SupervoxelRequest& request, ProgressSink& progress,
                                   const CancelToken& cancel) {
  if (request.outputs.empty()) throw ConfigError("no output given; add -o FILE");
  check_text_output(request.table, "--table", request.overwrite);
  check_text_output(request.adjacency, "--adjacency", request.overwrite);
  if (!request.table.empty() && request.table == request.adjacency)
    throw ConfigError("--table and --adjacency name the same file");
  SupervoxelReport report;
  report.parameters = request.parameters;
  validate(report.parameters);
  RecordingSink sink(progress, report);
  Stopwatch watch(report);
  const ThreadLimit limit(request.threads);
  const double cpu_before = process_cpu_seconds();
  const std::vector<std::filesystem::path> paths = io::expand_inputs(request.inputs);
  refuse_bad_outputs(request, paths);
  io::InputSet inputs(paths, request.tolerance);
  ProblemWarnings problems(inputs, sink);
  problems.forward();
  Writers writers =
      open_writers(request, inputs, {{"SupervoxelId", ColumnType::kUint32, "supervoxel, 0 none"}}, true, report);
  inputs.exclude(request.exclusion);

  auto [survey, scale, colours] = survey_scan(inputs, request, problems, report, sink, cancel);
  watch.lap("survey");

  const RunFolder folder(request.temp_dir);
  const SupervoxelScene scene =
      make_supervoxel_scene(inputs, survey,
                            {report.parameters, scale, request.memory_bytes, request.tile_points_cap,
                             !request.adjacency.empty(), folder.path()},
                            std::move(colours), sink, cancel);
  const SupervoxelStageResult& clusters = scene.clusters;
  report.colours = scene.colours;
  report.voxels = scene.store.size();
  report.peak_temp_bytes = scene.peak_temp_bytes;
  report.supervoxels = clusters.count;
  report.coarse = clusters.coarse;
  report.groups = clusters.groups;
  report.neighbour_pairs = clusters.adjacency.size();
  report.tiles = clusters.tiles;
  report.largest_tile_voxels = clusters.largest_tile_voxels;
  report.predicted_peak_bytes = scene.predicted_peak_bytes;
  watch.lap("supervoxels");

  const tiling::LatticeMapper mapper(inputs.sources(), survey.lattice);
  const LabelPass pass{mapper, scene.labels(), sink, cancel};
  if (!request.table.empty()) {
    require_room_for_moments(scene, request.memory_bytes);
    merge::SupervoxelMoments moments(clusters.count, kReachCells * scale.seed_steps);
    sum_moments(inputs, pass, moments);
    write_supervoxel_table(request.table, moments.table(clusters.adjacency), moments, survey.lattice,
                           request.overwrite);
    watch.lap("table");
  }
  if (!request.adjacency.empty()) write_adjacency(request.adjacency, clusters.adjacency, request.overwrite);
  report.points_out = write_labels(inputs, pass, writers);
  commit_writers(request, writers, inputs, report, sink);
  watch.lap("write");
  report.cpu_seconds = process_cpu_seconds() - cpu_before;
  report.peak_resident_bytes = peak_resident_bytes();
  return report;
}

nlohmann::ordered_json supervoxel_json(const SupervoxelParameters& p) {
  using Json = nlohmann::ordered_json;
  const bool fpfh = p.features == SupervoxelParameters::Features::kFpfh;
  Json json{{"features", fpfh ? "fpfh" : "normal"},
            {"voxel", p.voxel},
            {"seed", p.seed},
            {"iterations", p.iterations},
            {"seed_support", p.seed_support}};
  json["weights"] = fpfh
                        ? Json{{"lambda", p.lambda}, {"mu", p.mu}, {"epsilon", p.epsilon}, {"m", p.colour_scale}}
                        : Json{{"normal", p.normal_weight}, {"spatial", p.spatial_weight}, {"colour", p.colour_weight}};
  return json;
}

nlohmann::ordered_json to_json(const SupervoxelReport& r) {
  nlohmann::ordered_json json = report_head(r, "arris-supervoxel-report/1");
  json["parameters"] = supervoxel_json(r.parameters);
  json["colour"] = r.colours;
  json["points"] = {{"in", r.points_in}, {"out", r.points_out}, {"unlabelled", dropped_json(r)}};
  json["voxels"] = r.voxels;
  json["supervoxels"] = {{"count", r.supervoxels},
                         {"on_coarser_voxels", r.coarse},
                         {"without_seed", r.groups},
                         {"neighbour_pairs", r.neighbour_pairs}};
  json["tiles"] = {{"count", r.tiles}, {"largest_voxels", r.largest_tile_voxels}};
  append_report_tail(json, r);
  return json;
}

}  // namespace arris::pipeline
