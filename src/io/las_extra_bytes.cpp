#include "io/las_extra_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "io/bytes.h"
#include "io/las_layout.h"

namespace arris::io {
namespace {

constexpr std::size_t kMaxPayload = kMostExtraBytesPayload;
constexpr std::uint16_t kExtraBytesRecord = 4;
/// One entry can cover at most this many undocumented bytes: their number is kept in one byte.
constexpr std::size_t kMaxUndocumentedBytes = 255;
constexpr std::array<const char*, 11> kTypeNames{"undocumented", "uint8",  "int8",  "uint16", "int16", "uint32",
                                                 "int32",        "uint64", "int64", "float",  "double"};
constexpr std::array<std::size_t, 11> kTypeBytes{0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};

/// Field offsets of an entry.
constexpr std::size_t kType = 2, kOptions = 3, kName = 4, kScaleField = 112, kShiftField = 136, kDescription = 160;

/// Types 1 to 10 in the order of their codes.
constexpr std::array<ScalarType, 10> kScalarTypes{
    ScalarType::kUint8, ScalarType::kInt8,   ScalarType::kUint16, ScalarType::kInt16,   ScalarType::kUint32,
    ScalarType::kInt32, ScalarType::kUint64, ScalarType::kInt64,  ScalarType::kFloat32, ScalarType::kFloat64};
constexpr std::uint8_t kHasScale = 8, kHasShift = 16;  ///< Option bits.

std::size_t attribute_size(std::uint8_t type, std::uint8_t options) {
  if (type == 0) return options;
  return kTypeBytes[(type - 1) % 10 + 1] * ((type - 1U) / 10U + 1U);
}

void add_undocumented(std::vector<std::byte>& entries, std::size_t size_bytes) {
  while (size_bytes > 0) {
    const std::size_t part = std::min(size_bytes, kMaxUndocumentedBytes);
    entries.resize(entries.size() + kExtraBytesEntryBytes);
    std::byte* entry = entries.data() + entries.size() - kExtraBytesEntryBytes;
    entry[kOptions] = static_cast<std::byte>(part);
    store_text(entry + kName, 32, "undocumented");
    size_bytes -= part;
  }
}

void read_transform(const std::byte* entry, ExtraAttribute& attribute) {
  const auto options = load<std::uint8_t>(entry + kOptions);
  for (std::size_t i = 0; i < attribute.parts(); ++i) {
    const auto scale = load<double>(entry + kScaleField + 8 * i);
    const auto shift = load<double>(entry + kShiftField + 8 * i);
    if ((options & kHasScale) != 0 && std::isfinite(scale) && scale != 0.0) attribute.scale[i] = scale;
    if ((options & kHasShift) != 0 && std::isfinite(shift)) attribute.shift[i] = shift;
  }
}

void read_attributes(ExtraBytes& extra, std::size_t first_offset) {
  for (std::size_t at = 0; at + kExtraBytesEntryBytes <= extra.entries.size(); at += kExtraBytesEntryBytes) {
    const std::byte* entry = extra.entries.data() + at;
    ExtraAttribute attribute;
    attribute.type = load<std::uint8_t>(entry + kType);
    if (attribute.type > 30) {
      extra.valid = false;
      extra.problems.push_back(
          {"extra-bytes-type",
           fmt::format("extra-bytes entry {} has the unknown type {}; all extra bytes are taken as undocumented",
                       at / kExtraBytesEntryBytes + 1, attribute.type),
           extra.record_begin});
      return;
    }
    attribute.name = field_text(entry + kName, 32);
    attribute.description = field_text(entry + kDescription, 32);
    attribute.offset = first_offset + extra.described_bytes;
    attribute.size_bytes = attribute_size(attribute.type, load<std::uint8_t>(entry + kOptions));
    if (attribute.type != 0) read_transform(entry, attribute);
    extra.described_bytes += attribute.size_bytes;
    extra.attributes.push_back(std::move(attribute));
  }
  if (extra.described_bytes > extra.present_bytes) {
    extra.valid = false;
    extra.problems.push_back({"extra-bytes-mismatch",
                              fmt::format("{} extra bytes are described, {} are present; all are taken as undocumented",
                                          extra.described_bytes, extra.present_bytes),
                              extra.record_begin});
  }
}

void append(std::vector<std::byte>& to, const std::vector<std::byte>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

std::string extra_type_name(std::uint8_t type) {
  if (type > 30) return fmt::format("type {}", type);
  if (type <= 10) return kTypeNames[type];
  return fmt::format("{}[{}]", kTypeNames[(type - 1U) % 10U + 1U], (type - 1U) / 10U + 1U);
}

bool is_extra_bytes_record(const LasVlr& record) {
  return record.is("LASF_Spec", kExtraBytesRecord);
}

ExtraBytes read_extra_bytes(const InputFile& file, const LasFile& las) {
  ExtraBytes extra;
  const std::size_t format_bytes = kLasPointLayouts[las.header.point_format].size_bytes;
  extra.present_bytes = las.header.record_bytes - format_bytes;
  for (const auto* records : {&las.vlrs, &las.evlrs}) {
    for (const LasVlr& record : *records) {
      if (!is_extra_bytes_record(record)) continue;
      // No record has room for more attributes than bytes; a damaged file must not make us keep more.
      if (extra.entries.size() > kLasMaxRecordBytes * kExtraBytesEntryBytes) {
        extra.valid = false;
        extra.problems.push_back({"extra-bytes-many",
                                  fmt::format("more than {} extra bytes are described, which no record has; all are "
                                              "taken as undocumented",
                                              kLasMaxRecordBytes),
                                  record.begin});
        extra.entries.clear();
        return extra;
      }
      std::vector<std::byte> payload = read_payload(file, record, kMaxPayload);
      if (record.payload_bytes % kExtraBytesEntryBytes != 0) {
        extra.whole_entries = false;
        extra.problems.push_back({"extra-bytes-length",
                                  fmt::format("an extra-bytes record has {} bytes, no multiple of {}",
                                              record.payload_bytes, kExtraBytesEntryBytes),
                                  record.begin});
      }
      if (extra.entries.empty()) extra.record_begin = record.begin;
      payload.resize(payload.size() / kExtraBytesEntryBytes * kExtraBytesEntryBytes);
      append(extra.entries, payload);
    }
  }
  read_attributes(extra, format_bytes);
  if (!extra.valid) {
    extra.attributes.clear();
    extra.described_bytes = 0;
  }
  return extra;
}

ScalarType ExtraAttribute::part_type() const {
  return kScalarTypes[(type - 1U) % 10U];
}

std::uint8_t extra_type_code(ScalarType type) {
  const auto found = std::find(kScalarTypes.begin(), kScalarTypes.end(), type);
  return static_cast<std::uint8_t>(found - kScalarTypes.begin() + 1);
}

std::vector<std::byte> describe_attribute(std::uint8_t type, std::string_view name, std::string_view description) {
  std::vector<std::byte> entry(kExtraBytesEntryBytes);
  entry[kType] = static_cast<std::byte>(type);
  store_text(&entry[kName], 32, name);
  store_text(&entry[kDescription], 32, description);
  return entry;
}

std::vector<std::byte> describe_columns(const std::vector<ColumnSpec>& columns) {
  std::vector<std::byte> entries;
  for (const ColumnSpec& column : columns) {
    append(entries, describe_attribute(extra_type_code(scalar_type(column.type)), column.name, column.description));
  }
  return entries;
}

std::vector<std::byte> whole_description(const ExtraBytes& extra) {
  std::vector<std::byte> entries;
  if (extra.valid) entries = extra.entries;
  add_undocumented(entries, extra.present_bytes - extra.described_bytes);
  return entries;
}

std::vector<std::byte> vlr_header(std::string_view user_id, std::uint16_t record_id, std::size_t payload_bytes,
                                  std::string_view description) {
  std::vector<std::byte> header(kVlrHeaderBytes);
  store_text(header.data() + 2, 16, user_id);
  store<std::uint16_t>(header.data() + 18, record_id);
  store<std::uint16_t>(header.data() + 20, static_cast<std::uint16_t>(payload_bytes));
  store_text(header.data() + 22, 32, description);
  return header;
}

std::vector<std::byte> extra_bytes_vlr_header(std::size_t payload_bytes) {
  return vlr_header("LASF_Spec", kExtraBytesRecord, payload_bytes, "Extra Bytes");
}

ExtraBytesPlan plan_extra_bytes(const InputFile& file, const LasFile& las, const std::vector<ColumnSpec>& columns) {
  ExtraBytesPlan plan;
  if (columns.empty()) return plan;
  const std::size_t row_bytes = row_size_bytes(columns);
  if (row_bytes > kLasMaxRecordBytes - las.header.record_bytes) {
    throw ConfigError(
        fmt::format("{}: records of {} bytes cannot take {} more (limit {}); write PLY or ask for fewer columns",
                    file.name(), las.header.record_bytes, row_bytes, kLasMaxRecordBytes));
  }
  const ExtraBytes extra = read_extra_bytes(file, las);
  std::vector<std::byte> additions;
  add_undocumented(additions, extra.present_bytes - extra.described_bytes);
  append(additions, describe_columns(columns));

  for (std::size_t i = 0; i < las.vlrs.size(); ++i) {
    if (is_extra_bytes_record(las.vlrs[i])) plan.append_to = static_cast<int>(i);
  }
  const bool in_evlrs = std::any_of(las.evlrs.begin(), las.evlrs.end(), is_extra_bytes_record);
  const bool sound = extra.valid && extra.whole_entries && !in_evlrs;
  const bool fits = plan.append_to >= 0 && las.vlrs[plan.append_to].payload_bytes + additions.size() <= kMaxPayload;
  if (sound && fits) {
    plan.appended = std::move(additions);
    return plan;
  }
  if (!sound) {
    // Descriptions that cannot be extended in place are rewritten in one record; the old ones stay, marked as
    // superseded.
    plan.supersede_vlrs = plan.append_to >= 0;
    plan.supersede_evlrs = in_evlrs;
    if (extra.valid) append(plan.new_payload, extra.entries);
    plan.warnings.push_back(fmt::format(
        "{}: its extra-bytes description cannot be extended as it is; it is kept as superseded and replaced",
        file.name()));
  }
  plan.append_to = -1;
  append(plan.new_payload, additions);
  if (plan.new_payload.size() > kMaxPayload) {
    throw ConfigError(fmt::format(
        "{}: describing {} extra attributes exceeds the limit of {} per record; write PLY or ask for fewer columns",
        file.name(), plan.new_payload.size() / kExtraBytesEntryBytes, kMaxPayload / kExtraBytesEntryBytes));
  }
  return plan;
}

}  // namespace arris::io
