#include "io/las_crs.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/text.h"
#include "io/bytes.h"
#include "io/wkt.h"

namespace arris::io {
namespace {

constexpr std::size_t kMaxText = 4000;
constexpr std::size_t kMaxPayload = 65535;

/// GeoTIFF keys (OGC GeoTIFF 1.1): location 34737 means text, 0 means that the value is in the entry itself.
constexpr std::uint16_t kTextLocation = 34737;
constexpr std::uint16_t kWktRecord = 2112, kKeysRecord = 34735, kTextsRecord = 34737;
constexpr std::size_t kKeyBytes = 8;  ///< Of an entry of the directory; the first one is its header.
constexpr std::uint16_t kAngularUnit = 2054, kLinearUnit = 3076;
constexpr std::uint16_t kGeneralCitation = 1026, kGeographicCode = 2048, kGeographicCitation = 2049,
                        kProjectedCode = 3072, kProjectedCitation = 3073;
constexpr std::uint16_t kFirstPrivateCode = 32767;

const LasVlr* find_record(const LasFile& las, std::uint16_t record_id) {
  for (const auto* records : {&las.vlrs, &las.evlrs}) {
    for (const LasVlr& record : *records) {
      if (record.is("LASF_Projection", record_id) && record.payload_bytes > 0) return &record;
    }
  }
  return nullptr;
}

std::vector<std::byte> find_payload(const InputFile& file, const LasFile& las, std::uint16_t record_id) {
  const LasVlr* record = find_record(las, record_id);
  return record ? read_payload(file, *record, kMaxPayload) : std::vector<std::byte>{};
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.back() == '\0' || text.back() == '|' || text.back() == ' ' || text.back() == '\n'))
    text.remove_suffix(1);
  return text;
}

struct GeoKey {
  std::uint16_t key;
  std::uint16_t location;
  std::uint16_t count;
  std::uint16_t value;
};

/// The entries that are there, however many the directory claims.
std::vector<GeoKey> read_keys(const std::vector<std::byte>& directory) {
  std::vector<GeoKey> keys;
  if (directory.size() < kKeyBytes) return keys;
  const std::size_t entries =
      std::min<std::size_t>(load<std::uint16_t>(&directory[6]), directory.size() / kKeyBytes - 1);
  for (std::size_t i = 1; i <= entries; ++i) {
    const std::byte* entry = &directory[i * kKeyBytes];
    keys.push_back({load<std::uint16_t>(entry), load<std::uint16_t>(entry + 2), load<std::uint16_t>(entry + 4),
                    load<std::uint16_t>(entry + 6)});
  }
  return keys;
}

std::string unit_name(std::uint16_t code) {
  switch (code) {
    case 0:
      return {};
    case 9001:
      return "metre";
    case 9002:
      return "foot";
    case 9003:
      return "US survey foot";
    case 9102:
      return "degree";
    default:
      return fmt::format("EPSG unit {}", code);
  }
}

CrsSummary from_geotiff(const std::vector<std::byte>& directory, const std::vector<std::byte>& texts) {
  std::string citation;
  std::uint16_t projected = 0, geographic = 0, linear = 0, angular = 0;
  for (const GeoKey& key : read_keys(directory)) {
    if (key.location == 0 && key.key == kProjectedCode) projected = key.value;
    if (key.location == 0 && key.key == kGeographicCode) geographic = key.value;
    if (key.location == 0 && key.key == kLinearUnit) linear = key.value;
    if (key.location == 0 && key.key == kAngularUnit) angular = key.value;
    const bool cites = key.key == kGeneralCitation || key.key == kGeographicCitation || key.key == kProjectedCitation;
    if (key.location != kTextLocation || !cites || key.value >= texts.size()) continue;
    if (citation.size() > kMaxText) continue;  // Thousands of long ones would take minutes to compare.
    const std::string_view all(reinterpret_cast<const char*>(texts.data()), texts.size());
    const std::string_view text = trimmed(all.substr(key.value, std::min<std::size_t>(key.count, kMaxText)));
    if (!text.empty() && citation.find(text) == std::string::npos)
      citation += (citation.empty() ? "" : "; ") + std::string(text);
  }
  const std::uint16_t code = projected != 0 ? projected : geographic;
  const bool registered = code != 0 && code < kFirstPrivateCode;
  CrsSummary crs;
  crs.unit = unit_name(projected != 0 || linear != 0 ? linear : angular);
  if (citation.empty()) {
    crs.name = registered ? fmt::format("EPSG:{}", code) : std::string{};
  } else {
    crs.name = printable(registered ? fmt::format("{} (EPSG:{})", citation, code) : citation, kMaxText);
  }
  crs.text = crs.name;
  crs.epsg = registered ? code : 0;
  return crs;
}

}  // namespace

CrsSummary describe_crs(const InputFile& file, const LasFile& las) {
  const std::vector<std::byte> wkt = find_payload(file, las, kWktRecord);
  const std::string_view text = trimmed(field_text(wkt.data(), wkt.size()));
  if (text.empty()) return from_geotiff(find_payload(file, las, kKeysRecord), find_payload(file, las, kTextsRecord));
  return {printable(wkt_name(text), kMaxText), printable(wkt_unit(text), kMaxText), printable(text, kMaxText),
          wkt_epsg(text)};
}

void note_crs_problems(const InputFile& file, const LasFile& las, std::vector<Problem>& problems) {
  for (const auto* records : {&las.vlrs, &las.evlrs}) {
    for (const LasVlr& record : *records) {
      if (!record.is("LASF_Projection", kWktRecord)) continue;
      const std::vector<std::byte> wkt = read_payload(file, record, kMaxPayload);
      if (!trimmed(field_text(wkt.data(), wkt.size())).empty()) continue;
      problems.push_back({"crs-empty", "the record of the coordinate reference system (WKT) is empty", record.begin});
    }
  }
  const LasVlr* keys = find_record(las, kKeysRecord);
  if (keys == nullptr) return;
  const std::vector<std::byte> directory = read_payload(file, *keys, kMaxPayload);
  const std::size_t claimed = directory.size() < kKeyBytes ? 0 : load<std::uint16_t>(&directory[6]);
  if (directory.size() < kKeyBytes || directory.size() / kKeyBytes - 1 < claimed) {
    problems.push_back({"crs-keys",
                        fmt::format("the GeoTIFF directory of {} bytes cannot hold the {} keys that it counts",
                                    directory.size(), claimed),
                        keys->begin});
  }
  if (find_record(las, kWktRecord) != nullptr) {
    problems.push_back({"crs-both",
                        "the coordinate reference system is given twice, as WKT and as GeoTIFF keys; WKT is shown",
                        keys->begin});
  }
}

}  // namespace arris::io
