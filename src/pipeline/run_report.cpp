#include "pipeline/run_report.h"

#include <nlohmann/json.hpp>

#include "core/version.h"
#include "pipeline/libraries.h"

namespace arris::pipeline {

using Json = nlohmann::ordered_json;

Json report_head(const RunReport& r, const char* schema) {
  Json json;
  json["schema"] = schema;
  json["arris"] = kVersion;
  json["libraries"] = pipeline::library_versions();
  json["lattice"] = {{"step", r.lattice.step}, {"origin", r.lattice.origin}};
  json["spacing"] = r.spacing;
  for (const InputReport& input : r.inputs) {
    Json entry{{"path", input.path}, {"layout", input.layout}, {"points", input.points}, {"bytes", input.size_bytes}};
    if (!input.hash.empty()) entry["xxh3_64"] = input.hash;
    json["inputs"].push_back(entry);
  }
  json["outputs"] = r.outputs;
  return json;
}

Json dropped_json(const RunReport& r) {
  return {
      {"non_finite", r.dropped_nonfinite}, {"out_of_range", r.dropped_out_of_range}, {"excluded", r.dropped_excluded}};
}

void append_report_tail(Json& json, const RunReport& r) {
  json["threads"] = r.threads;
  json["memory"] = {{"budget_bytes", r.memory_budget_bytes},
                    {"predicted_peak_bytes", r.predicted_peak_bytes},
                    {"measured_peak_bytes", r.peak_resident_bytes}};
  json["temp"] = {{"predicted_bytes", r.predicted_temp_bytes}, {"measured_peak_bytes", r.peak_temp_bytes}};
  for (const auto& [phase, seconds] : r.seconds) json["seconds"][phase] = seconds;
  json["cpu_seconds"] = r.cpu_seconds;
  json["warnings"] = Json::array();
  for (const WarningReport& w : r.warnings) json["warnings"].push_back({{"code", w.code}, {"text", w.text}});
}

}  // namespace arris::pipeline
