/// @file arris info for people.

#include <fmt/format.h>

#include "core/text.h"
#include "info_report.h"

namespace arris::tools {
namespace {

std::string number(const io::ColumnStatistics& c, double value) {
  if (c.finite == 0) return "-";
  return fmt::format("{:.10g}", value);
}

std::string points_text(const io::PointStatistics& points, double spacing) {
  std::string text = fmt::format("  points   {}", grouped(points.points));
  if (points.without_position > 0) text += fmt::format(" ({} without a position)", grouped(points.without_position));
  text += "\n";
  if (points.points == points.without_position) return text;
  text += fmt::format("  min      {:.10g} {:.10g} {:.10g}\n", points.extent.min[0], points.extent.min[1],
                      points.extent.min[2]);
  text += fmt::format("  max      {:.10g} {:.10g} {:.10g}\n", points.extent.max[0], points.extent.max[1],
                      points.extent.max[2]);
  text += fmt::format("  spacing  about {:.3g}\n", spacing);
  std::string classes;
  for (std::size_t label = 0; label < points.classes.size(); ++label) {
    if (points.classes[label] > 0)
      classes += fmt::format("{}{}: {}", classes.empty() ? "" : ", ", label, grouped(points.classes[label]));
  }
  if (!classes.empty()) text += fmt::format("  classes  {}\n", classes);
  return text;
}

std::string ranges_text(const io::PointStatistics& points) {
  std::string text = fmt::format("  {:<24} {:<8} {:>18} {:>18}\n", "attribute", "type", "least", "most");
  for (const io::ColumnStatistics& c : points.columns) {
    text += fmt::format("  {:<24} {:<8} {:>18} {:>18}", printable(c.column.name, 60), io::type_name(c.column.type),
                        number(c, c.min), number(c, c.max));
    if (c.not_finite > 0) text += fmt::format("  {} not finite", grouped(c.not_finite));
    text += "\n";
  }
  return text;
}

}  // namespace

std::string to_text(const InfoReport& report) {
  const io::FileSummary& file = report.file;
  std::string text = fmt::format("{}\n  {}, {}\n", printable(file.info.path.string(), 4096), file.info.layout,
                                 human_bytes(file.info.size_bytes));
  text += report.points ? points_text(*report.points, report.spacing)
                        : fmt::format("  points   {} (not read)\n", grouped(file.info.points));
  if (!file.crs.name.empty() || !file.crs.text.empty()) {
    text += fmt::format("  crs      {}{}\n", file.crs.name.empty() ? "unnamed" : file.crs.name,
                        file.crs.unit.empty() ? "" : ", unit " + file.crs.unit);
  }
  for (const auto& [name, value] : file.header) text += fmt::format("  {:<24} {}\n", name, value);
  if (report.points) text += ranges_text(*report.points);
  for (const io::AttributeSummary& a : file.attributes) {
    if (file.info.format == io::Format::kPly && report.points && a.type.rfind("list", 0) != 0) continue;
    text += fmt::format("  stored   {} ({}){}\n", a.name, a.type, a.description.empty() ? "" : ": " + a.description);
  }
  for (const io::RecordSummary& r : file.records) {
    text += fmt::format("  record   {} {} ({} {}){}\n", r.user_id, r.record_id, r.length,
                        file.info.format == io::Format::kLas ? "bytes" : "records",
                        r.description.empty() ? "" : ": " + r.description);
  }
  for (const io::Problem& p : file.problems)
    text += fmt::format("  problem  {} [{}, byte {}]\n", p.text, p.code, p.byte);
  return text;
}

}  // namespace arris::tools
