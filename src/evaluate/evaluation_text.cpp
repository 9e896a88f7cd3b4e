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

std::string_view name(SpacingOf spacing_of) {
  return spacing_of == SpacingOf::kWhole ? "whole" : spacing_of == SpacingOf::kLocal ? "local" : "local_max";
}

/// Spacings per unit of the tolerances.
double tolerance_unit(const ContourEvaluation& evaluation) {
  return evaluation.spacing_of == SpacingOf::kWhole ? evaluation.spacing : 1.0;
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
          {"recall_of_corners", number(row.recall_of_corners)},
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

Json labels_json(const std::optional<LabelAgreement>& labels) {
  if (!labels) return nullptr;
  return {{"tolerance_spacings", labels->tolerance_spacings},
          {"true_positives", labels->true_positives},
          {"false_positives", labels->false_positives},
          {"false_negatives", labels->false_negatives},
          {"true_negatives", labels->true_negatives},
          {"iou", number(labels->iou)},
          {"mcc", number(labels->mcc)}};
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
  for (const ToleranceResult& row : evaluation.tolerances) rows.push_back(row_json(row, tolerance_unit(evaluation)));
  const Json result{{"schema", 1},
                    {"spacing", evaluation.spacing},
                    {"spacing_of", name(evaluation.spacing_of)},
                    {"noise", evaluation.noise},
                    {"truth_edges", evaluation.truth_edges},
                    {"truth_length", evaluation.truth_length},
                    {"corner_length", evaluation.corner_length},
                    {"detections", evaluation.detections},
                    {"masked", evaluation.masked},
                    {"below_min_score", evaluation.below_min_score},
                    {"non_finite", evaluation.non_finite},
                    {"tolerances", rows},
                    {"labels", labels_json(evaluation.labels)},
                    {"mean_to_truth", number(evaluation.mean_to_truth)},
                    {"mean_to_detections", number(evaluation.mean_to_detections)},
                    {"chamfer", number(evaluation.chamfer)},
                    {"hausdorff", number(evaluation.hausdorff)},
                    {"hausdorff_95", number(evaluation.hausdorff_95)}};
  return result.dump(2) + "\n";
}

std::string to_csv(const ContourEvaluation& evaluation) {
  std::string text =
      "tolerance,tolerance_spacings,true_positives,false_positives,precision,recall,f1,average_precision,ceiling,"
      "offset_mean,offset_rms,thinness,gaps,longest_gap,recall_of_corners";
  for (const EdgeKind kind : kAllEdgeKinds) text += fmt::format(",recall_{}", name(kind));
  text += ",iou,mcc\n";
  const auto cell = [](const std::optional<double>& value) { return value ? fmt::format("{:.6g}", *value) : ""; };
  for (const ToleranceResult& row : evaluation.tolerances) {
    text += fmt::format("{:.6g},{:.6g},{},{}", row.tolerance, row.tolerance / tolerance_unit(evaluation),
                        row.true_positives, row.false_positives);
    for (const auto& value : {row.precision, row.recall, row.f1, row.average_precision, row.ceiling, row.offset_mean,
                              row.offset_rms, row.thinness}) {
      text += ',';
      text += cell(value);
    }
    text += fmt::format(",{},{:.6g},{}", row.gaps, row.longest_gap, cell(row.recall_of_corners));
    for (const auto& recall : row.recall_of_kind) {
      text += ',';
      text += cell(recall);
    }
    const auto label = [&](const std::optional<double> LabelAgreement::*value) {
      return evaluation.labels ? cell((*evaluation.labels).*value) : "";
    };
    text += fmt::format(",{},{}\n", label(&LabelAgreement::iou), label(&LabelAgreement::mcc));
  }
  return text;
}

std::string to_table(const ContourEvaluation& evaluation) {
  std::string text = fmt::format("truth      {} edges, {:.6g} long; spacing {:.6g}, noise {:.6g}\n",
                                 evaluation.truth_edges, evaluation.truth_length, evaluation.spacing, evaluation.noise);
  text += fmt::format("detections {} ({} of other classes, {} below the least score, {} without a position)\n",
                      evaluation.detections, evaluation.masked, evaluation.below_min_score, evaluation.non_finite);
  if (evaluation.spacing_of != SpacingOf::kWhole) {
    text += fmt::format("tolerances and offsets are in local spacings ({}) of each edge\n",
                        evaluation.spacing_of == SpacingOf::kLocal ? "mean" : "coarser direction");
  }
  text += '\n';
  constexpr std::string_view kRow = "{:>9} {:>6} {:>9} {:>7} {:>7} {:>7} {:>7} {:>9} {:>9} {:>8} {:>6} {:>9}\n";
  text += fmt::format(kRow, "tolerance", "(s)", "precision", "recall", "F1", "AP", "ceiling", "offset", "rms",
                      "thinness", "gaps", "longest");
  for (const ToleranceResult& row : evaluation.tolerances) {
    text += fmt::format(kRow, length_text(row.tolerance), length_text(row.tolerance / tolerance_unit(evaluation)),
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
  if (evaluation.corner_length > 0.0) {
    text += fmt::format("{:<14}", "corners");
    for (const ToleranceResult& row : evaluation.tolerances)
      text += fmt::format(" {:>8}", share_text(row.recall_of_corners));
    text += '\n';
  }
  if (evaluation.labels) {
    text +=
        fmt::format("\nlabels of the input's points at {:g} s: IoU {}, MCC {}\n", evaluation.labels->tolerance_spacings,
                    share_text(evaluation.labels->iou), share_text(evaluation.labels->mcc));
  }
  text += fmt::format("\nchamfer {}, hausdorff {}, 95 % {}\n", length_text(evaluation.chamfer),
                      length_text(evaluation.hausdorff), length_text(evaluation.hausdorff_95));
  return text;
}

}  // namespace arris::evaluate
