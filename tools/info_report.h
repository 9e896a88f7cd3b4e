#pragma once
/// @file What arris info shows of one file, as text and as JSON.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "io/file_summary.h"
#include "io/point_statistics.h"

namespace arris::tools {

struct InfoReport {
  io::FileSummary file;
  std::optional<io::PointStatistics> points;  ///< Absent if only the header was asked for.
  double spacing = 0.0;
};

nlohmann::ordered_json to_json(const InfoReport& report);
std::string to_text(const InfoReport& report);

}  // namespace arris::tools
