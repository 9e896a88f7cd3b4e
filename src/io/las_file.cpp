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
                                      kind, records.size() + 1, claimed, at, limit)});
      break;
    }
    records.push_back(std::move(record));
  }
  return records;
}

/// Where the points must end at the latest: the next structure that the header points to, if it lies behind their
/// start.
std::uint64_t next_structure(const InputFile& file, const LasHeader& header) {
  std::uint64_t end = file.size_bytes();
  if (header.evlr_count > 0 && header.evlr_start > header.offset_to_points) end = std::min(end, header.evlr_start);
  if (header.waveform_start > header.offset_to_points) end = std::min(end, header.waveform_start);
  return end;
}

void settle_points(const InputFile& file, LasFile& las) {
  const LasHeader& header = las.header;
  const std::uint64_t record_bytes = header.record_bytes;
  PointCounts counts;
  counts.legacy = header.legacy_count;
  if (header.minor >= 4) counts.extended = header.point_count;
  counts.room = (next_structure(file, header) - header.offset_to_points) / record_bytes;
  counts.file_room = (file.size_bytes() - header.offset_to_points) / record_bytes;
  las.points = choose_point_count(counts);

  const bool compressed =
      std::any_of(las.vlrs.begin(), las.vlrs.end(), [](const LasVlr& vlr) { return vlr.is("laszip encoded", 22204); });
  // Without the compression bits the record may be a leftover of decompression: then the points fill their room
  // exactly.
  if (compressed && las.points != counts.room) refuse_compressed(file);
  if (compressed)
    las.problems.push_back({"stale-laszip-vlr", "a LASzip record is present although the points are not compressed"});

  if (las.points > counts.file_room) {
    const auto needed = checked_multiply(las.points, record_bytes);
    const auto end = needed ? checked_add(*needed, header.offset_to_points) : std::nullopt;
    throw InputError(
        fmt::format("{}: the header promises {} points of {} bytes from byte {} to {}, but the file ends at byte {} "
                    "and holds {} whole points; "
                    "it is cut short, copy or export it again",
                    file.name(), las.points, record_bytes, header.offset_to_points,
                    end ? std::to_string(*end) : "beyond 2^64", file.size_bytes(), counts.file_room));
  }
  las.points_end = header.offset_to_points + las.points * record_bytes;

  if (counts.extended && counts.legacy != 0 && counts.legacy != *counts.extended) {
    las.problems.push_back(
        {"count-mismatch",
         fmt::format("the header counts {} points in 32 bits and {} in 64, the file has room for {}; {} are read",
                     counts.legacy, *counts.extended, counts.room, las.points)});
  } else if (las.points == 0 && counts.room > 0) {
    las.problems.push_back(
        {"count-zero", fmt::format("the header counts no points, but {} bytes follow it; they are not read as points",
                                   file.size_bytes() - header.offset_to_points)});
  }
}

void note_oddities(const InputFile& file, LasFile& las) {
  const LasHeader& header = las.header;
  for (std::size_t axis = 0; axis < 3 && las.points > 0; ++axis) {
    if (!std::isfinite(header.min[axis]) || !std::isfinite(header.max[axis]) || header.min[axis] > header.max[axis]) {
      las.problems.push_back({"bounds-invalid", fmt::format("the header's {} range [{}, {}] is not a range",
                                                            "xyz"[axis], header.min[axis], header.max[axis])});
    }
  }
  const bool wkt = (header.global_encoding & kEncodingWkt) != 0;
  if (is_extended_format(header.point_format) && !wkt) {
    las.problems.push_back(
        {"wkt-bit", fmt::format("point format {} needs the WKT bit of the global encoding, which is not set",
                                header.point_format)});
  }
  if (las.evlrs.empty() && header.waveform_start == 0 && file.size_bytes() > las.points_end && las.points > 0) {
    las.problems.push_back({"trailing-bytes", fmt::format("{} bytes follow the last point and belong to nothing",
                                                          file.size_bytes() - las.points_end)});
  }
}

}  // namespace

std::uint64_t choose_point_count(const PointCounts& counts) {
  const std::uint64_t legacy = counts.legacy;
  if (!counts.extended || *counts.extended == legacy) return legacy;
  const std::uint64_t extended = *counts.extended;
  if (legacy == 0) return extended;
  if (extended == 0) return legacy;
  if (legacy == counts.room) return legacy;
  if (extended == counts.room) return extended;
  return legacy <= counts.file_room ? legacy : extended;
}

LasFile read_las_file(const InputFile& file) {
  LasFile las;
  las.header = read_las_header(file, las.problems);
  const LasHeader& header = las.header;
  las.vlrs = walk_records(file, header.raw.size(), header.offset_to_points, header.vlr_count, false, las.problems);
  las.vlrs_end = las.vlrs.empty() ? header.raw.size() : las.vlrs.back().end();
  settle_points(file, las);
  if (header.evlr_count > 0) {
    const bool within_points = header.evlr_start < header.raw.size() ||
                               (header.evlr_start >= header.offset_to_points && header.evlr_start < las.points_end);
    if (within_points) {
      las.problems.push_back(
          {"evlr-overlap",
           fmt::format("extended records start at byte {}, within other data; they are ignored", header.evlr_start)});
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
