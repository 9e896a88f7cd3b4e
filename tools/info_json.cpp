/// @file arris info --json; docs/formats.md lists the keys.

#include <nlohmann/json.hpp>

#include "core/text.h"
#include "info_report.h"

namespace arris::tools {
namespace {

using Json = nlohmann::ordered_json;

Json records_json(const io::FileSummary& file) {
  Json records = Json::array();
  for (const io::RecordSummary& r : file.records) {
    records.push_back({{"user_id", r.user_id},
                       {"record_id", r.record_id},
                       {"description", r.description},
                       {"length", r.length},
                       {"extended", r.extended}});
  }
  return records;
}

Json attributes_json(const io::FileSummary& file) {
  Json attributes = Json::array();
  for (const io::AttributeSummary& a : file.attributes)
    attributes.push_back({{"name", a.name}, {"type", a.type}, {"description", a.description}});
  return attributes;
}

Json ranges_json(const io::PointStatistics& points) {
  Json ranges = Json::array();
  for (const io::ColumnStatistics& c : points.columns) {
    Json range{{"name", printable(c.column.name)}, {"type", io::type_name(c.column.type)}};
    range["min"] = c.finite > 0 ? Json(c.min) : Json();
    range["max"] = c.finite > 0 ? Json(c.max) : Json();
    if (c.not_finite > 0) range["not_finite"] = c.not_finite;
    ranges.push_back(std::move(range));
  }
  return ranges;
}

void add_points(const io::PointStatistics& points, double spacing, Json& json) {
  json["points"] = points.points;
  json["non_finite"] = points.without_position;
  const bool any = points.points > points.without_position;
  json["min"] = any ? Json(points.extent.min) : Json();
  json["max"] = any ? Json(points.extent.max) : Json();
  json["spacing"] = spacing;
  json["ranges"] = ranges_json(points);
  Json classes = Json::object();
  for (std::size_t label = 0; label < points.classes.size(); ++label) {
    if (points.classes[label] > 0) classes[std::to_string(label)] = points.classes[label];
  }
  json["classes"] = std::move(classes);
  json["by_return"] = points.by_return;
}

}  // namespace

Json to_json(const InfoReport& report) {
  const io::FileSummary& file = report.file;
  Json json{{"path", printable(file.info.path.string(), 4096)},
            {"layout", file.info.layout},
            {"bytes", file.info.size_bytes},
            {"crs", {{"name", file.crs.name}, {"unit", file.crs.unit}, {"text", file.crs.text}}}};
  json["points"] = file.info.points;
  if (report.points) add_points(*report.points, report.spacing, json);
  json["header"] = Json::object();
  for (const auto& [name, value] : file.header) json["header"][name] = value;
  if (file.claimed_bounds)
    json["claimed_bounds"] = {{"min", file.claimed_bounds->min}, {"max", file.claimed_bounds->max}};
  json["records"] = records_json(file);
  json["attributes"] = attributes_json(file);
  json["problems"] = Json::array();
  for (const io::Problem& p : file.problems)
    json["problems"].push_back({{"code", p.code}, {"byte", p.byte}, {"text", p.text}});
  return json;
}

}  // namespace arris::tools
