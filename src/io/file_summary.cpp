#include "io/file_summary.h"

#include <fmt/format.h>

#include "core/text.h"
#include "io/bytes.h"
#include "io/las_crs.h"
#include "io/las_extra_bytes.h"
#include "io/las_file.h"
#include "io/las_layout.h"
#include "io/ply_header.h"

namespace arris::io {
namespace {

constexpr std::size_t kMaxRecords = 1000;  ///< Listed; the rest is counted.
constexpr std::size_t kMaxComments = 100;

std::string triple(const std::array<double, 3>& v) {
  return fmt::format("{} {} {}", v[0], v[1], v[2]);
}

/// A GUID as its text form: three little-endian numbers and eight bytes.
std::string guid(const std::byte* at) {
  std::string text = fmt::format("{:08x}-{:04x}-{:04x}-", load<std::uint32_t>(at), load<std::uint16_t>(at + 4),
                                 load<std::uint16_t>(at + 6));
  for (std::size_t i = 8; i < 16; ++i) text += fmt::format("{}{:02x}", i == 10 ? "-" : "", load<std::uint8_t>(at + i));
  return text;
}

std::string by_return(const LasHeader& header) {
  std::string text;
  const bool wide = header.minor >= 4;
  for (std::size_t i = 0; i < (wide ? 15U : 5U); ++i) {
    const std::uint64_t count = wide ? load<std::uint64_t>(&header.raw[kPointsByReturn + 8 * i])
                                     : load<std::uint32_t>(&header.raw[kLegacyByReturn + 4 * i]);
    text += fmt::format("{}{}", i > 0 ? " " : "", count);
  }
  return text;
}

void add_las_header(const LasFile& las, FileSummary& summary) {
  const LasHeader& header = las.header;
  const std::byte* raw = header.raw.data();
  const auto add = [&](const char* name, std::string value) { summary.header.emplace_back(name, std::move(value)); };
  add("version", fmt::format("1.{}", header.minor));
  add("file source id", fmt::format("{}", load<std::uint16_t>(raw + kFileSourceId)));
  add("global encoding", fmt::format("{:#06x}", header.global_encoding));
  add("guid", guid(raw + kGuid));
  add("system identifier", printable(field_text(raw + kSystemIdentifier, 32)));
  add("generating software", printable(field_text(raw + kGeneratingSoftware, 32)));
  add("creation day of year", fmt::format("{}", load<std::uint16_t>(raw + kCreationDay)));
  add("creation year", fmt::format("{}", load<std::uint16_t>(raw + kCreationYear)));
  add("header size", fmt::format("{}", header.raw.size()));
  add("offset to points", fmt::format("{}", header.offset_to_points));
  add("variable-length records", fmt::format("{}", header.vlr_count));
  add("point format", fmt::format("{}", header.point_format));
  add("point record length", fmt::format("{}", header.record_bytes));
  add("points (32 bit)", fmt::format("{}", header.legacy_count));
  if (header.minor >= 4) add("points (64 bit)", fmt::format("{}", header.point_count));
  add("points by return", by_return(header));
  add("scale", triple(header.scale));
  add("offset", triple(header.offset));
  add("min", triple(header.min));
  add("max", triple(header.max));
  if (header.minor >= 3) add("start of waveform data", fmt::format("{}", header.waveform_start));
  if (header.minor >= 4) {
    add("start of extended records", fmt::format("{}", header.evlr_start));
    add("extended records", fmt::format("{}", header.evlr_count));
  }
  const std::uint64_t gap = header.offset_to_points - las.vlrs_end;
  if (gap > 0) add("bytes between records and points", fmt::format("{}", gap));
}

void add_records(const std::vector<LasVlr>& records, FileSummary& summary) {
  for (const LasVlr& record : records) {
    if (summary.records.size() == kMaxRecords) {
      summary.problems.push_back(
          {"many-records", fmt::format("only the first {} variable-length records are listed", kMaxRecords)});
      return;
    }
    summary.records.push_back({printable(record.user_id), record.record_id, printable(record.description),
                               record.payload_bytes, record.extended});
  }
}

void add_extra_bytes(const InputFile& file, const LasFile& las, FileSummary& summary) {
  const ExtraBytes extra = read_extra_bytes(file, las);
  for (const ExtraAttribute& attribute : extra.attributes) {
    summary.attributes.push_back({printable(attribute.name), extra_type_name(attribute.type),
                                  printable(attribute.description), attribute.size_bytes});
  }
  if (extra.present_bytes > extra.described_bytes) {
    summary.attributes.push_back({"", extra_type_name(0), "", extra.present_bytes - extra.described_bytes});
  }
}

void summarize_las(const InputFile& file, FileSummary& summary) {
  const LasFile las = read_las_file(file, summary.info.tolerance);
  add_las_header(las, summary);
  summary.claimed_bounds = WorldExtent{las.header.min, las.header.max};
  add_records(las.vlrs, summary);
  add_records(las.evlrs, summary);
  add_extra_bytes(file, las, summary);
  summary.crs = describe_crs(file, las);
}

void summarize_ply(const InputFile& file, FileSummary& summary) {
  const PlyHeader header = read_ply_header(file);
  summary.header.emplace_back("format", header.format_name());
  summary.header.emplace_back("version", printable(header.version, 40));
  for (const std::string& line : header.lines) {
    const std::size_t end = line.find(' ');
    const std::string word = line.substr(0, end);
    if ((word != "comment" && word != "obj_info") || end == std::string::npos || summary.header.size() >= kMaxComments)
      continue;
    summary.header.emplace_back(word, printable(line.substr(end + 1)));
  }
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex" || summary.records.size() >= kMaxRecords) continue;
    summary.records.push_back({printable(element.name), 0, "", element.count, false});
  }
  const bool binary = header.format != PlyFormat::kAscii;
  for (const PlyProperty& p : header.vertices().properties) {
    if (summary.attributes.size() >= kMaxRecords) break;
    std::string type =
        p.is_list ? fmt::format("list {} {}", type_name(p.count_type), type_name(p.type)) : type_name(p.type);
    summary.attributes.push_back(
        {printable(p.name), std::move(type), "", binary && !p.is_list ? size_bytes(p.type) : 0});
  }
}

}  // namespace

FileSummary summarize_file(const std::filesystem::path& path, Tolerance tolerance) {
  return summarize_file(std::make_shared<const InputFile>(path), tolerance);
}

FileSummary summarize_file(std::shared_ptr<const InputFile> file, Tolerance tolerance) {
  FileSummary summary;
  summary.info = open_point_source(file, tolerance)->info();
  summary.problems = summary.info.problems;
  if (summary.info.format == Format::kLas) {
    summarize_las(*file, summary);
  } else {
    summarize_ply(*file, summary);
  }
  return summary;
}

}  // namespace arris::io
