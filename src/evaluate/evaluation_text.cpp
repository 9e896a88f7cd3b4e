#include "evaluate/evaluation_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

namespace arris::evaluate {

namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json row_json(const ToleranceResult& row, double spacing) {
  Json kinds = Json::object();
  for (const EdgeKind kind : kAllEdgeKinds) {
    const auto& recall = row.recall_of_kind[static_cast<std::size_t>(kind)];
    if (recall) kinds[std::string(name(kind))] = *recall;
  }
  return {{"tolerance", row.tolerance},
          {"tolerance_spacings", row.tolerance / spacing},
          {"true_positives", row.true_positives},
          {"false_positives", row.false_positives},
          {"forgiven", row.forgiven},
          {"precision", number(row.precision)},
          {"recall", number(row.recall)},
          {"f1", number(row.f1)},
          {"recall_by_kind", kinds},
          {"ceiling", number(row.ceiling)},
          {"average_precision", number(row.average_precision)},
          {"offset_mean", number(row.offset_mean)},
          {"offset_median", number(row.offset_median)},
          {"offset_rms", number(row.offset_rms)},
          {"thinness", number(row.thinness)},
          {"gaps", row.gaps},
          {"gaps_per_length", number(row.gaps_per_length)},
          {"longest_gap", row.longest_gap}};
}

std::string share_text(const std::optional<double>& value) {
  return value ? fmt::format("{:.4f}", *value) : "-";
}
std::string length_text(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : "-";
}

}  // namespace

std::string to_json(const ContourEvaluation& evaluation) {
  Json rows = Json::array();
  for (const ToleranceResult& row : evaluation.tolerances) rows.push_back(row_json(row, evaluation.spacing));
  const Json result{{"schema", 1},
                    {"spacing", evaluation.spacing},
                    {"noise", evaluation.noise},
                    {"truth_edges", evaluation.truth_edges},
                    {"truth_length", evaluation.truth_length},
                    {"detections", evaluation.detections},
                    {"masked", evaluation.masked},
                    {"non_finite", evaluation.non_finite},
                    {"tolerances", rows},
                    {"mean_to_truth", number(evaluation.mean_to_truth)},
                    {"mean_to_detections", number(evaluation.mean_to_detections)},
                    {"chamfer", number(evaluation.chamfer)},
                    {"hausdorff", number(evaluation.hausdorff)},
                    {"hausdorff_95", number(evaluation.hausdorff_95)}};
  return result.dump(2) + "\n";
}

std::string to_table(const ContourEvaluation& evaluation) {
  std::string text = fmt::format("truth      {} edges, {:.6g} long; spacing {:.6g}, noise {:.6g}\n",
                                 evaluation.truth_edges, evaluation.truth_length, evaluation.spacing, evaluation.noise);
  text += fmt::format("detections {} ({} of other classes, {} without a position)\n\n", evaluation.detections,
                      evaluation.masked, evaluation.non_finite);
  constexpr std::string_view kRow = "{:>9} {:>6} {:>9} {:>7} {:>7} {:>7} {:>7} {:>9} {:>9} {:>8} {:>6} {:>9}\n";
  text += fmt::format(kRow, "tolerance", "(s)", "precision", "recall", "F1", "AP", "ceiling", "offset", "rms",
                      "thinness", "gaps", "longest");
  for (const ToleranceResult& row : evaluation.tolerances) {
    text += fmt::format(kRow, length_text(row.tolerance), length_text(row.tolerance / evaluation.spacing),
                        share_text(row.precision), share_text(row.recall), share_text(row.f1),
                        share_text(row.average_precision), share_text(row.ceiling), length_text(row.offset_mean),
                        length_text(row.offset_rms), length_text(row.thinness), row.gaps, length_text(row.longest_gap));
  }
  text += "\nrecall by kind";
  for (const ToleranceResult& row : evaluation.tolerances) text += fmt::format(" {:>8}", length_text(row.tolerance));
  text += '\n';
  for (const EdgeKind kind : kAllEdgeKinds) {
    const std::size_t index = static_cast<std::size_t>(kind);
    if (evaluation.tolerances.empty() || !evaluation.tolerances.front().recall_of_kind[index]) continue;
    text += fmt::format("{:<14}", name(kind));
    for (const ToleranceResult& row : evaluation.tolerances)
      text += fmt::format(" {:>8}", share_text(row.recall_of_kind[index]));
    text += '\n';
  }
  text += fmt::format("\nchamfer {}, hausdorff {}, 95 % {}\n", length_text(evaluation.chamfer),
                      length_text(evaluation.hausdorff), length_text(evaluation.hausdorff_95));
  return text;
}

}  // namespace arris::evaluate
