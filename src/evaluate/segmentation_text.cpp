#include "evaluate/segmentation_text.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "core/text.h"
#include "evaluate/plane_text.h"

namespace arris::evaluate {

namespace {

using Json = nlohmann::ordered_json;
using Figure = std::pair<std::string_view, std::optional<double>>;

Json number(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

std::optional<double> share(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

std::optional<double> variation_of_information(const OverlapMeasures& overlaps) {
  if (!overlaps.information_split) return std::nullopt;
  return *overlaps.information_split + *overlaps.information_joined;
}

/// What does not depend on the tolerance, under its names in JSON and CSV.
std::array<Figure, 10> figures(const SegmentationComparison& c) {
  const OverlapMeasures& o = c.overlaps;
  return {{{"unsegmented_share", share(c.unsegmented, c.judged)},
           {"undersegmentation", o.undersegmentation},
           {"corrected_undersegmentation", o.corrected_undersegmentation},
           {"achievable_accuracy", o.achievable_accuracy},
           {"adjusted_rand", o.adjusted_rand},
           {"variation_of_information", variation_of_information(o)},
           {"information_split", o.information_split},
           {"information_joined", o.information_joined},
           {"points_per_segment", c.points_per_segment},
           {"compactness", c.compactness}}};
}

std::string share_text(const std::optional<double>& value) {
  return value ? fmt::format("{:.4f}", *value) : "-";
}

}  // namespace

std::string to_json(const SegmentationComparison& c) {
  Json result{{"schema", 1},
              {"spacing", c.spacing},
              {"radius", c.radius},
              {"points", c.judged},
              {"left_out", c.left_out},
              {"unsegmented", c.unsegmented},
              {"segments", c.overlaps.segments},
              {"faces", c.overlaps.faces}};
  for (const auto& [name, value] : figures(c)) result[std::string(name)] = number(value);
  result["truth_boundary_points"] = c.truth_boundary;
  result["segment_boundary_points"] = c.segment_boundary;
  Json rows = Json::array();
  for (const BoundaryAgreement& row : c.boundaries) {
    rows.push_back({{"tolerance", row.tolerance},
                    {"tolerance_spacings", row.tolerance / c.spacing},
                    {"recall", number(row.recall)},
                    {"precision", number(row.precision)}});
  }
  result["boundaries"] = rows;
  if (c.planes) result["planes"] = planes_json(*c.planes);
  return result.dump(2) + "\n";
}

std::string to_csv(const SegmentationComparison& c) {
  std::string names = "tolerance,tolerance_spacings,boundary_recall,boundary_precision,points,segments,faces";
  std::string same = fmt::format("{},{},{}", c.judged, c.overlaps.segments, c.overlaps.faces);
  const auto cell = [](const std::optional<double>& value) { return value ? fmt::format("{:.6g}", *value) : ""; };
  for (const auto& [name, value] : figures(c)) {
    names += fmt::format(",{}", name);
    same += fmt::format(",{}", cell(value));
  }
  if (c.planes) {
    for (const auto& [name, value] : planes_cells(*c.planes)) {
      names += fmt::format(",{}", name);
      same += fmt::format(",{}", value);
    }
  }
  std::string text = names + "\n";
  for (const BoundaryAgreement& row : c.boundaries) {
    text += fmt::format("{:.6g},{:.6g},{},{},{}\n", row.tolerance, row.tolerance / c.spacing, cell(row.recall),
                        cell(row.precision), same);
  }
  return text;
}

std::string to_table(const SegmentationComparison& c) {
  const OverlapMeasures& o = c.overlaps;
  std::string text = fmt::format("points    {} ({} on no surface left out), {} % without a segment\n",
                                 grouped(c.judged), grouped(c.left_out),
                                 c.judged > 0 ? fmt::format("{:.3g}", 100.0 * *share(c.unsegmented, c.judged)) : "-");
  text += fmt::format("segments  {} of {} points on average, on {} surfaces; compactness {}\n\n", grouped(o.segments),
                      c.points_per_segment ? fmt::format("{:.4g}", *c.points_per_segment) : "-", grouped(o.faces),
                      share_text(c.compactness));
  const auto line = [&](std::string_view name, const std::optional<double>& value, std::string_view best) {
    text += fmt::format("{:<28} {:>8}  ({})\n", name, share_text(value), best);
  };
  line("undersegmentation, 5 % rule", o.undersegmentation, "best 0");
  line("corrected undersegmentation", o.corrected_undersegmentation, "best 0");
  line("achievable accuracy", o.achievable_accuracy, "best 1");
  line("adjusted Rand index", o.adjusted_rand, "best 1");
  line("variation of information", variation_of_information(o), "bits, best 0");
  line("  surfaces split", o.information_split, "bits");
  line("  surfaces joined", o.information_joined, "bits");
  text += fmt::format("\nboundary points within {:.4g} of another label: {} of the truth, {} of the segments\n",
                      c.radius, grouped(c.truth_boundary), grouped(c.segment_boundary));
  constexpr std::string_view kRow = "{:>9} {:>6} {:>8} {:>9}\n";
  text += fmt::format(kRow, "tolerance", "(s)", "recall", "precision");
  for (const BoundaryAgreement& row : c.boundaries) {
    text += fmt::format(kRow, fmt::format("{:.4g}", row.tolerance), fmt::format("{:.3g}", row.tolerance / c.spacing),
                        share_text(row.recall), share_text(row.precision));
  }
  if (c.planes) text += fmt::format("\n{}", planes_table(*c.planes));
  return text;
}

}  // namespace arris::evaluate
