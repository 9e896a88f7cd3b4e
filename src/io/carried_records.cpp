#include "io/carried_records.h"

#include <algorithm>

#include "core/text.h"
#include "io/bytes.h"
#include "io/kept_writers.h"
#include "io/las_extra_bytes.h"
#include "io/las_layout.h"
#include "io/ply_header.h"
#include "io/ply_output.h"

namespace arris::io {
namespace {

constexpr std::uint16_t kFirstWaveform = 100, kLastWaveform = 354, kWaveformData = 65535;
constexpr std::uint16_t kGpsTimeType = 1;  ///< Bit of the global encoding.
constexpr std::size_t kMostWktBytes = 60000;

bool is_carried(const LasVlr& record) {
  if (record.is("laszip encoded", 22204) || is_extra_bytes_record(record)) return false;
  const bool described = record.record_id >= kFirstWaveform && record.record_id <= kLastWaveform;
  return record.user_id != "LASF_Spec" || !(described || record.record_id == kWaveformData);
}

/// The WKT of a "comment crs" line, if it is more than a name.
std::string wkt_of_ply(const SourceInfo& input) {
  for (const std::string& line : read_ply_header(InputFile(input.path)).lines) {
    if (!line.starts_with(kPlyCrsComment)) continue;
    const std::string text = line.substr(kPlyCrsComment.size());
    if (text.find('[') != std::string::npos && text.size() <= kMostWktBytes) return text;
  }
  return {};
}

std::uint32_t copy_carried(const InputFile& from, const std::vector<LasVlr>& records, OutputFile& to) {
  std::uint32_t count = 0;
  for (const LasVlr& record : records) {
    if (!is_carried(record)) continue;
    copy_bytes(from, record.begin, record.end(), to);
    ++count;
  }
  return count;
}

}  // namespace

CarriedRecords::CarriedRecords(const std::vector<SourceInfo>& inputs) {
  const auto first =
      std::find_if(inputs.begin(), inputs.end(), [](const SourceInfo& input) { return input.format == Format::kLas; });
  if (first == inputs.end()) {
    path_ = inputs.at(0).path;
    ply_wkt_ = wkt_of_ply(inputs.at(0));
    return;
  }
  path_ = first->path;
  las_file_ = std::make_unique<InputFile>(path_);
  las_ = read_las_file(*las_file_, first->tolerance);
}

std::string CarriedRecords::name() const {
  return printable(path_.string(), 1000);
}

std::uint32_t CarriedRecords::write_vlrs(OutputFile& output) const {
  if (las_file_) return copy_carried(*las_file_, las_.vlrs, output);
  if (ply_wkt_.empty()) return 0;
  output.write(std::span<const std::byte>(vlr_header("LASF_Projection", 2112, ply_wkt_.size() + 1, "WKT")));
  output.write(std::string_view(ply_wkt_.c_str(), ply_wkt_.size() + 1));  // With its NUL.
  return 1;
}

std::uint32_t CarriedRecords::write_evlrs(OutputFile& output) const {
  return las_file_ ? copy_carried(*las_file_, las_.evlrs, output) : 0;
}

void CarriedRecords::set_encoding(bool extended, std::span<std::byte> header) const {
  if (!las_file_) return;
  const auto has = [&](std::uint16_t id) {
    const auto is = [&](const LasVlr& record) { return record.is("LASF_Projection", id); };
    return std::any_of(las_.vlrs.begin(), las_.vlrs.end(), is) || std::any_of(las_.evlrs.begin(), las_.evlrs.end(), is);
  };
  const unsigned encoding = las_.header.global_encoding;
  const bool wkt = (encoding & kEncodingWkt) != 0 || (extended && (has(2112) || !has(34735)));
  store<std::uint16_t>(&header[kGlobalEncoding],
                       static_cast<std::uint16_t>((encoding & kGpsTimeType) | (wkt ? kEncodingWkt : 0U)));
}

}  // namespace arris::io
