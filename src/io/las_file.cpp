#include "io/las_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "io/bytes.h"
#include "io/las_header.h"
#include "io/las_layout.h"

namespace arris::io {
namespace {

/// More records than any real file has; a damaged count must not cost memory.
constexpr std::size_t kMaxRecords = 65536;

LasVlr parse_record_header(const std::byte* bytes, std::uint64_t begin, bool extended) {
  LasVlr record;
  record.user_id = field_text(bytes + 2, 16);
  record.record_id = load<std::uint16_t>(bytes + 18);
  record.payload_bytes = extended ? load<std::uint64_t>(bytes + 20) : load<std::uint16_t>(bytes + 20);
  record.description = field_text(bytes + (extended ? 28 : 22), 32);
  record.extended = extended;
  record.begin = begin;
  record.payload = begin + (extended ? kEvlrHeaderBytes : kVlrHeaderBytes);
  return record;
}

/// Follows `claimed` records from `begin`, none of which may pass `limit`. What stops the walk early becomes a problem.
std::vector<LasVlr> walk_records(const InputFile& file, std::uint64_t begin, std::uint64_t limit, std::uint64_t claimed,
                                 bool extended, std::vector<Problem>& problems) {
  const std::size_t header_bytes = extended ? kEvlrHeaderBytes : kVlrHeaderBytes;
  const char* kind = extended ? "EVLR" : "VLR";
  std::array<std::byte, kEvlrHeaderBytes> bytes{};
  std::vector<LasVlr> records;
  for (std::uint64_t at = begin; records.size() < claimed; at = records.back().end()) {
    const bool header_fits = at <= limit && limit - at >= header_bytes;
    LasVlr record;
    if (header_fits) {
      file.read(at, std::span(bytes).first(header_bytes));
      record = parse_record_header(bytes.data(), at, extended);
    }
    if (!header_fits || record.payload_bytes > limit - record.payload || records.size() == kMaxRecords) {
      problems.push_back({extended ? "evlr-overrun" : "vlr-overrun",
                          fmt::format("{} {} of {} at byte {} runs past byte {}; it and what follows it are ignored",
                                      kind, records.size() + 1, claimed, at, limit),
                          at});
      break;
    }
    records.push_back(std::move(record));
  }
  return records;
}

void note_oddities(const InputFile& file, LasFile& las) {
  const LasHeader& header = las.header;
  for (std::size_t axis = 0; axis < 3 && las.points > 0; ++axis) {
    if (!std::isfinite(header.min[axis]) || !std::isfinite(header.max[axis]) || header.min[axis] > header.max[axis]) {
      las.problems.push_back({"bounds-invalid",
                              fmt::format("the header's {} range [{}, {}] is not a range", "xyz"[axis],
                                          header.min[axis], header.max[axis]),
                              kBounds + 16 * axis});
    }
  }
  const bool wkt = (header.global_encoding & kEncodingWkt) != 0;
  if (is_extended_format(header.point_format) && !wkt) {
    las.problems.push_back(
        {"wkt-bit",
         fmt::format("point format {} needs the WKT bit of the global encoding, which is not set", header.point_format),
         kGlobalEncoding});
  }
  if (is_extended_format(header.point_format) && header.minor >= 4 && header.legacy_count != 0) {
    las.problems.push_back({"legacy-count",
                            fmt::format("point format {} must leave the 32-bit count 0, it is {}", header.point_format,
                                        header.legacy_count),
                            kLegacyCount});
  }
  if (las.evlrs.empty() && header.waveform_start == 0 && file.size_bytes() > las.points_end && las.points > 0) {
    las.problems.push_back(
        {"trailing-bytes",
         fmt::format("{} bytes follow the last point and belong to nothing", file.size_bytes() - las.points_end),
         las.points_end});
  }
}

}  // namespace

LasFile read_las_file(const InputFile& file, Tolerance tolerance) {
  LasFile las;
  las.header = read_las_header(file, las.problems);
  const LasHeader& header = las.header;
  las.vlrs = walk_records(file, header.raw.size(), header.offset_to_points, header.vlr_count, false, las.problems);
  las.vlrs_end = las.vlrs.empty() ? header.raw.size() : las.vlrs.back().end();
  settle_point_count(file, tolerance, las);
  if (header.evlr_count > 0) {
    const bool within_points = header.evlr_start < header.raw.size() ||
                               (header.evlr_start >= header.offset_to_points && header.evlr_start < las.points_end);
    if (within_points) {
      las.problems.push_back(
          {"evlr-overlap",
           fmt::format("extended records start at byte {}, within other data; they are ignored", header.evlr_start),
           kEvlrStart});
    } else {
      las.evlrs = walk_records(file, header.evlr_start, file.size_bytes(), header.evlr_count, true, las.problems);
    }
  }
  note_oddities(file, las);
  return las;
}

std::vector<std::byte> read_payload(const InputFile& file, const LasVlr& record, std::size_t limit_bytes) {
  std::vector<std::byte> bytes(static_cast<std::size_t>(std::min<std::uint64_t>(record.payload_bytes, limit_bytes)));
  file.read(record.payload, bytes);
  return bytes;
}

bool is_crs_record(const LasVlr& record) {
  if (record.user_id != "LASF_Projection") return false;
  const std::uint16_t id = record.record_id;
  return id == 2111 || id == 2112 || (id >= 34735 && id <= 34737);
}

}  // namespace arris::io
