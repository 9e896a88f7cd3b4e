#include "io/las_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "io/bytes.h"
#include "io/las_layout.h"

namespace arris::io {
namespace {

/// The first header_size bytes, after checking the few fields needed to know how many these are.
std::vector<std::byte> read_raw_header(const InputFile& file, std::vector<Problem>& problems) {
  constexpr std::size_t kLeast = kLasHeaderBytes[0];
  std::vector<std::byte> raw(kLeast);
  const std::size_t got = file.read_some(0, raw);
  if (got < 4 || field_text(raw.data(), 4) != "LASF")
    refuse(file, 0, "this is not a LAS file: it does not begin with \"LASF\"", "give a LAS or PLY file");
  if (got < kLeast) {
    refuse(file, got, fmt::format("the file ends here, within the header of at least {} bytes", kLeast),
           "it is cut short: copy or export it again");
  }
  const auto major = load<std::uint8_t>(&raw[kVersionMajor]);
  const auto minor = load<std::uint8_t>(&raw[kVersionMinor]);
  if (major != 1 || minor > kLasNewestMinor) {
    refuse(file, kVersionMajor, fmt::format("the header declares LAS {}.{}", major, minor),
           fmt::format("versions 1.0 to 1.{} can be read: export it as one of them", kLasNewestMinor));
  }
  const std::size_t size = load<std::uint16_t>(&raw[kHeaderSize]);
  // Some 1.3 writers keep the 227 bytes of 1.2, some 1.5 ones the 375 of 1.4; what follows is then absent.
  const std::size_t least = minor >= 4 ? kLasHeaderBytes[4] : kLeast;
  if (size < least) {
    refuse(file, kHeaderSize, fmt::format("header size {} is below the {} bytes of LAS 1.{}", size, least, minor),
           "the header is damaged: export the file again");
  }
  if (size < kLasHeaderBytes[minor]) {
    problems.push_back({"header-size",
                        fmt::format("header size {} is below the {} bytes of LAS 1.{}; absent fields read as 0", size,
                                    kLasHeaderBytes[minor], minor),
                        kHeaderSize});
  }
  if (size > file.size_bytes()) {
    refuse(file, file.size_bytes(), fmt::format("the file ends here, within the header of {} bytes", size),
           "it is cut short: copy or export it again");
  }
  raw.resize(size);
  file.read(0, raw);
  return raw;
}

void check_coordinates(const InputFile& file, const LasHeader& header) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double scale = header.scale[axis];
    const double offset = header.offset[axis];
    const double reach = std::abs(scale) * 2147483648.0 + std::abs(offset);
    if (!(std::abs(scale) > 0.0) || !std::isfinite(reach)) {
      const bool bad_scale = !(std::abs(scale) > 0.0) || !std::isfinite(scale);
      refuse(file, (bad_scale ? kScale : kOffset) + 8 * axis,
             fmt::format("{} scale {} and offset {} cannot give coordinates", "xyz"[axis], scale, offset),
             "repair the header or export the file again");
    }
  }
}

void check_point_format(const InputFile& file, const LasHeader& header, std::vector<Problem>& problems) {
  if (header.point_format >= kLasPointFormats) {
    refuse(file, kPointFormat, fmt::format("point format {} is unknown", header.point_format),
           "formats 0 to 10 can be read: export the file as one of them");
  }
  const std::size_t least = kLasPointLayouts[header.point_format].size_bytes;
  if (header.record_bytes < least) {
    refuse(file, kRecordLength,
           fmt::format("record length {} is below the {} bytes of point format {}", header.record_bytes, least,
                       header.point_format),
           "the header is damaged: export the file again");
  }
  const int since = is_extended_format(header.point_format) ? 4
                    : header.point_format >= 4              ? 3
                    : header.point_format >= 2              ? 2
                                                            : 0;
  if (header.minor < since) {
    problems.push_back({"point-format-version",
                        fmt::format("point format {} does not exist in LAS 1.{}; read as LAS 1.{} defines it",
                                    header.point_format, header.minor, since),
                        kPointFormat});
  }
}

}  // namespace

void refuse_compressed(const InputFile& file, std::uint64_t byte) {
  refuse(file, byte, "the points are compressed (LAZ), which this version cannot read", "decompress it to LAS first");
}

LasHeader read_las_header(const InputFile& file, std::vector<Problem>& problems) {
  LasHeader header;
  header.raw = read_raw_header(file, problems);
  const std::byte* raw = header.raw.data();
  header.minor = load<std::uint8_t>(raw + kVersionMinor);
  header.global_encoding = load<std::uint16_t>(raw + kGlobalEncoding);
  header.offset_to_points = load<std::uint32_t>(raw + kOffsetToPoints);
  header.vlr_count = load<std::uint32_t>(raw + kVlrCount);
  const auto format_byte = load<std::uint8_t>(raw + kPointFormat);
  if ((format_byte & 0xC0) != 0) refuse_compressed(file, kPointFormat);
  header.point_format = format_byte;
  header.record_bytes = load<std::uint16_t>(raw + kRecordLength);
  header.legacy_count = load<std::uint32_t>(raw + kLegacyCount);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    header.scale[axis] = load<double>(raw + kScale + 8 * axis);
    header.offset[axis] = load<double>(raw + kOffset + 8 * axis);
    header.max[axis] = load<double>(raw + kBounds + 16 * axis);
    header.min[axis] = load<double>(raw + kBounds + 16 * axis + 8);
  }
  if (header.minor >= 3 && header.raw.size() >= kLasHeaderBytes[3]) {
    header.waveform_start = load<std::uint64_t>(raw + kWaveformStart);
  }
  if (header.minor >= 4) {
    header.evlr_start = load<std::uint64_t>(raw + kEvlrStart);
    header.evlr_count = load<std::uint32_t>(raw + kEvlrCount);
    header.point_count = load<std::uint64_t>(raw + kPointCount);
  }
  check_point_format(file, header, problems);
  check_coordinates(file, header);
  if (header.offset_to_points < header.raw.size()) {
    refuse(file, kOffsetToPoints,
           fmt::format("offset to points {} lies within the header of {} bytes", header.offset_to_points,
                       header.raw.size()),
           "the header is damaged: export the file again");
  }
  if (header.offset_to_points > file.size_bytes()) {
    refuse(file, kOffsetToPoints,
           fmt::format("points start at byte {}, but the file ends at byte {}", header.offset_to_points,
                       file.size_bytes()),
           "it is cut short: copy or export it again");
  }
  return header;
}

}  // namespace arris::io
