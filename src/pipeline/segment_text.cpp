#include "pipeline/segment_text.h"

#include <fmt/format.h>

namespace arris::pipeline {
namespace {

constexpr const char* kHeader = "segment_id,points,area,area_from,rms,x,y,z,nx,ny,nz,inclination_deg,azimuth_deg";
constexpr const char* kCsv = "{},{},{:.6g},{},{:.6g},{:.4f},{:.4f},{:.4f},{:.6f},{:.6f},{:.6f},{:.3f},{}";
constexpr const char* kJson =
    R"({{"segment_id":{},"points":{},"area":{:.6g},"area_from":"{}","rms":{:.6g},"x":{:.4f},"y":{:.4f},"z":{:.4f},)"
    R"("nx":{:.6f},"ny":{:.6f},"nz":{:.6f},"inclination_deg":{:.3f},"azimuth_deg":{}}})";

std::string azimuth_text(const merge::SegmentRow& row, bool json) {
  const std::optional<double> azimuth = row.azimuth_deg();
  if (!azimuth) return json ? "null" : "";
  std::string text = fmt::format("{:.3f}", *azimuth);
  return text == "360.000" ? "0.000" : text;
}

}  // namespace

void write_segments(const std::filesystem::path& path, std::span<const merge::SegmentRow> rows, bool overwrite) {
  TextRows text(path, kHeader, overwrite);
  for (const merge::SegmentRow& row : rows) {
    text.add(fmt::format(fmt::runtime(text.json() ? kJson : kCsv), row.segment_id, row.points, row.area,
                         row.area_from_outline ? "outline" : "points", row.rms, row.centroid[0], row.centroid[1],
                         row.centroid[2], row.normal[0], row.normal[1], row.normal[2], row.inclination_deg(),
                         azimuth_text(row, text.json())));
  }
  text.commit();
}

}  // namespace arris::pipeline
