#include <fmt/format.h>

#include <algorithm>

#include "io/bytes.h"
#include "io/las_file.h"
#include "io/las_header.h"
#include "io/las_layout.h"

namespace arris::io {
namespace {

/// Where the points must end at the latest: the next structure that the header points to, if it lies behind their
/// start.
std::uint64_t next_structure(const InputFile& file, const LasHeader& header) {
  std::uint64_t end = file.size_bytes();
  if (header.evlr_count > 0 && header.evlr_start > header.offset_to_points) end = std::min(end, header.evlr_start);
  if (header.waveform_start > header.offset_to_points) end = std::min(end, header.waveform_start);
  return end;
}

/// The field that holds the count in question.
std::uint64_t count_field(const LasFile& las) {
  return las.points == las.header.legacy_count ? kLegacyCount : kPointCount;
}

void settle_lost_points(const InputFile& file, Tolerance tolerance, std::uint64_t file_room, LasFile& las) {
  const LasHeader& header = las.header;
  const auto needed = checked_multiply(las.points, header.record_bytes);
  const auto end = needed ? checked_add(*needed, header.offset_to_points) : std::nullopt;
  const std::string what = fmt::format(
      "the header counts {} points of {} bytes from byte {} to {}, but the file ends at byte {} and holds {} whole "
      "points",
      las.points, header.record_bytes, header.offset_to_points, end ? std::to_string(*end) : "beyond 2^64",
      file.size_bytes(), file_room);
  if (tolerance != Tolerance::kSalvage) {
    refuse(file, count_field(las), what, "copy or export the file again, or read what is there with --salvage");
  }
  las.problems.push_back(
      {"points-lost", fmt::format("{}; {} are lost", what, las.points - file_room), count_field(las)});
  las.points = file_room;
}

void settle_zero_points(const InputFile& file, Tolerance tolerance, std::uint64_t room, LasFile& las) {
  if (tolerance == Tolerance::kSalvage) {
    las.points = room;
    las.problems.push_back({"count-zero",
                            fmt::format("the header counts no points; the {} that there is room for are read", room),
                            count_field(las)});
    return;
  }
  las.problems.push_back(
      {"count-zero",
       fmt::format("the header counts no points, but {} bytes follow it; they are not read as points (see --salvage)",
                   file.size_bytes() - las.header.offset_to_points),
       count_field(las)});
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

void settle_point_count(const InputFile& file, Tolerance tolerance, LasFile& las) {
  const LasHeader& header = las.header;
  PointCounts counts;
  counts.legacy = header.legacy_count;
  if (header.minor >= 4) counts.extended = header.point_count;
  counts.room = (next_structure(file, header) - header.offset_to_points) / header.record_bytes;
  counts.file_room = (file.size_bytes() - header.offset_to_points) / header.record_bytes;
  las.points = choose_point_count(counts);

  const auto compressed =
      std::find_if(las.vlrs.begin(), las.vlrs.end(), [](const LasVlr& vlr) { return vlr.is("laszip encoded", 22204); });
  // Without the compression bits the record may be a leftover of decompression: then the points fill their room
  // exactly.
  if (compressed != las.vlrs.end()) {
    if (las.points != counts.room) refuse_compressed(file, compressed->begin);
    las.problems.push_back(
        {"stale-laszip-vlr", "a LASzip record is present although the points are not compressed", compressed->begin});
  }
  if (counts.extended && counts.legacy != 0 && counts.legacy != *counts.extended && las.points <= counts.file_room) {
    las.problems.push_back(
        {"count-mismatch",
         fmt::format("the header counts {} points in 32 bits and {} in 64, the file has room for {}; {} are read",
                     counts.legacy, *counts.extended, counts.room, las.points),
         kLegacyCount});
  }
  if (las.points > counts.file_room) settle_lost_points(file, tolerance, counts.file_room, las);
  if (las.points == 0 && counts.room > 0) settle_zero_points(file, tolerance, counts.room, las);
  las.points_end = header.offset_to_points + las.points * header.record_bytes;
}

}  // namespace arris::io
