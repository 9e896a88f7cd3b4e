#pragma once
/// @file The structure of a LAS file: header, variable-length records, and where its points lie. Reads no points.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/input_file.h"
#include "io/point_source.h"

namespace arris::io {

/// The header. Fields that the declared version lacks are zero, whatever the bytes in their place hold.
struct LasHeader {
  std::vector<std::byte> raw;  ///< The first header_size bytes of the file.
  int minor = 0;               ///< LAS 1.minor
  std::uint16_t global_encoding = 0;
  std::uint32_t offset_to_points = 0;
  std::uint32_t vlr_count = 0;  ///< As the header has it; LasFile::vlrs holds those that are there.
  std::uint8_t point_format = 0;
  std::size_t record_bytes = 0;
  std::uint32_t legacy_count = 0;
  std::array<double, 3> scale{};
  std::array<double, 3> offset{};
  std::array<double, 3> min{};
  std::array<double, 3> max{};
  std::uint64_t waveform_start = 0;
  std::uint64_t evlr_start = 0;
  std::uint32_t evlr_count = 0;
  std::uint64_t point_count = 0;  ///< 64-bit count of 1.4 and later.
};

/// Where a variable-length record lies. Texts are as in the file: pass them through printable() before showing them.
struct LasVlr {
  std::string user_id;
  std::uint16_t record_id = 0;
  std::string description;
  bool extended = false;
  std::uint64_t begin = 0;  ///< Offset in the file of its header ...
  std::uint64_t payload = 0;
  std::uint64_t payload_bytes = 0;

  std::uint64_t end() const { return payload + payload_bytes; }
  bool is(const char* user, std::uint16_t record) const { return record_id == record && user_id == user; }
};

struct LasFile {
  LasHeader header;
  std::vector<LasVlr> vlrs;
  std::vector<LasVlr> evlrs;
  std::uint64_t vlrs_end = 0;    ///< End of the last whole VLR; up to the points there may be a gap.
  std::uint64_t points = 0;      ///< Points that are there; see choose_point_count().
  std::uint64_t points_end = 0;  ///< End of the last point.
  std::vector<Problem> problems;
};

/// Reads and checks the structure. Throws InputError for files whose points cannot be trusted: bad magic or version,
/// compressed points, unknown point format, record shorter than its format, unusable scale or offset, points beyond the
/// end of the file (read as far as they go under kSalvage). Everything else that is wrong becomes a problem; it is for
/// the caller to refuse them under kStrict. Memory is bounded: no count of the file is believed before it is seen.
LasFile read_las_file(const InputFile& file, Tolerance tolerance = Tolerance::kUsual);

/// Payload of a record, at most `limit_bytes` of it.
std::vector<std::byte> read_payload(const InputFile& file, const LasVlr& record, std::size_t limit_bytes);

/// The coordinate reference system records of a file: WKT and GeoTIFF keys, in order.
bool is_crs_record(const LasVlr& record);

/// Three witnesses of the number of points: the 32-bit count, the 64-bit count (1.4 on), and the room in the file.
struct PointCounts {
  std::uint32_t legacy = 0;
  std::optional<std::uint64_t> extended;  ///< Absent before 1.4.
  std::uint64_t room = 0;       ///< Whole records between the first point and the next structure or the end of file.
  std::uint64_t file_room = 0;  ///< Whole records between the first point and the end of the file.
};

/// Where the header's counts agree, or one of them is zero, the count is theirs. Where they disagree, the one that
/// fills the room wins, else the 32-bit one if it fits (as the specification asks), else the 64-bit one.
std::uint64_t choose_point_count(const PointCounts& counts);

/// Sets las.points and las.points_end from the three witnesses, once the VLRs are known. Disagreement becomes a
/// problem; a count beyond the end of the file is refused, or cut to what is there under kSalvage, which also reads the
/// room of a file that counts nothing (a writer that was interrupted).
void settle_point_count(const InputFile& file, Tolerance tolerance, LasFile& las);

}  // namespace arris::io
