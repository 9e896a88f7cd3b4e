#include "io/las_crs.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/text.h"
#include "io/bytes.h"

namespace arris::io {
namespace {

constexpr std::size_t kMaxText = 4000;
constexpr std::size_t kMaxPayload = 65535;

/// GeoTIFF keys (OGC GeoTIFF 1.1): location 34737 means text, 0 means that the value is in the entry itself.
constexpr std::uint16_t kTextLocation = 34737;
constexpr std::uint16_t kGeneralCitation = 1026, kGeographicCode = 2048, kGeographicCitation = 2049,
                        kProjectedCode = 3072, kProjectedCitation = 3073;
constexpr std::uint16_t kFirstPrivateCode = 32767;

std::vector<std::byte> find_payload(const InputFile& file, const LasFile& las, std::uint16_t record_id) {
  for (const auto* records : {&las.vlrs, &las.evlrs}) {
    for (const LasVlr& record : *records) {
      if (record.is("LASF_Projection", record_id) && record.payload_bytes > 0)
        return read_payload(file, record, kMaxPayload);
    }
  }
  return {};
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.back() == '\0' || text.back() == '|' || text.back() == ' ' || text.back() == '\n'))
    text.remove_suffix(1);
  return text;
}

std::string from_geotiff(const std::vector<std::byte>& keys, const std::vector<std::byte>& texts) {
  constexpr std::size_t kEntryBytes = 8;
  if (keys.size() < kEntryBytes) return {};
  const std::size_t entries = std::min<std::size_t>(load<std::uint16_t>(&keys[6]), keys.size() / kEntryBytes - 1);
  std::string citation;
  std::uint16_t projected = 0;
  std::uint16_t geographic = 0;
  for (std::size_t i = 1; i <= entries; ++i) {
    const std::byte* entry = &keys[i * kEntryBytes];
    const auto key = load<std::uint16_t>(entry);
    const auto location = load<std::uint16_t>(entry + 2);
    const auto count = load<std::uint16_t>(entry + 4);
    const auto value = load<std::uint16_t>(entry + 6);
    if (location == 0 && key == kProjectedCode) projected = value;
    if (location == 0 && key == kGeographicCode) geographic = value;
    const bool cites = key == kGeneralCitation || key == kGeographicCitation || key == kProjectedCitation;
    if (location != kTextLocation || !cites || value >= texts.size()) continue;
    const std::string_view all(reinterpret_cast<const char*>(texts.data()), texts.size());
    const std::string_view text = trimmed(all.substr(value, count));
    if (!text.empty() && citation.find(text) == std::string::npos)
      citation += (citation.empty() ? "" : "; ") + std::string(text);
  }
  const std::uint16_t code = projected != 0 ? projected : geographic;
  const bool registered = code != 0 && code < kFirstPrivateCode;
  if (citation.empty()) return registered ? fmt::format("EPSG:{}", code) : std::string{};
  return registered ? fmt::format("{} (EPSG:{})", citation, code) : citation;
}

}  // namespace

std::string describe_crs(const InputFile& file, const LasFile& las) {
  const std::vector<std::byte> wkt = find_payload(file, las, 2112);
  const std::string_view text = trimmed(field_text(wkt.data(), wkt.size()));
  if (!text.empty()) return printable(text, kMaxText);
  return printable(from_geotiff(find_payload(file, las, 34735), find_payload(file, las, 34737)), kMaxText);
}

}  // namespace arris::io
