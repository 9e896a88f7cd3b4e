#include "io/las_conversion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/text.h"
#include "io/las_extra_bytes.h"
#include "io/las_file.h"
#include "io/las_layout.h"
#include "io/las_sharing.h"

namespace arris::io {

LasConversion::LasConversion(const KeptJob& job, const ColumnUnion& columns) : columns_(columns) {
  choose_format(job.inputs);
  record_bytes_ = kLasPointLayouts[point_format_].size_bytes;
  for (const LasField& field : las_fields(point_format_)) {
    const int column = columns_.find(field.name);
    if (column >= 0) fields_.push_back({field, static_cast<std::size_t>(column)});
  }
  number_column_ = columns_.find("return_number");
  returns_column_ = columns_.find("number_of_returns");
  for (const SourceInfo& input : job.inputs) input_record_bytes_.push_back(input.record_bytes);
  const bool all_las = std::all_of(job.inputs.begin(), job.inputs.end(),
                                   [](const SourceInfo& input) { return input.format == Format::kLas; });
  if (all_las && same_extra_bytes(job.inputs)) {
    const InputFile file(job.inputs[0].path);
    const ExtraBytes extra = read_extra_bytes(file, read_las_file(file, job.inputs[0].tolerance));
    verbatim_bytes_ = extra.present_bytes;
    for (const ExtraAttribute& attribute : extra.attributes) names_.push_back(attribute.name);
    entries_ = whole_description(extra);
    record_bytes_ += verbatim_bytes_;
  } else {
    add_extras();
  }
}

void LasConversion::choose_format(const std::vector<SourceInfo>& inputs) {
  bool legacy = true;
  for (const SourceInfo& input : inputs) {
    if (input.format == Format::kPly) {
      legacy = false;
      continue;
    }
    const std::uint8_t format = read_las_file(InputFile(input.path), input.tolerance).header.point_format;
    legacy = legacy && !is_extended_format(format);
  }
  const bool colour = columns_.find("red") >= 0 && columns_.find("green") >= 0 && columns_.find("blue") >= 0;
  const bool time = columns_.find("gps_time") >= 0;
  if (legacy) {
    point_format_ = static_cast<std::uint8_t>((colour ? 2 : 0) + (time ? 1 : 0));
  } else {
    point_format_ = static_cast<std::uint8_t>(colour ? (columns_.find("nir") >= 0 ? 8 : 7) : 6);
  }
}

bool LasConversion::is_field(std::string_view name) const {
  return name == "x" || name == "y" || name == "z" ||
         std::any_of(fields_.begin(), fields_.end(), [&](const Stored& s) { return s.field.name == name; });
}

/// What has no field of its own becomes an extra byte attribute of its type.
void LasConversion::add_extras() {
  std::string left_out;
  for (std::size_t i = 0; i < columns_.columns().size(); ++i) {
    const RecordColumn& column = columns_.columns()[i];
    if (is_field(column.name)) continue;
    if (entries_.size() + kExtraBytesEntryBytes > kMostExtraBytesPayload / 2) {
      if (left_out.size() < 200) left_out += (left_out.empty() ? "" : ", ") + printable(column.name_in_file, 40);
      continue;
    }
    const std::string name = column.name_in_file.substr(0, 32);
    if (name.size() < column.name_in_file.size())
      warnings_.push_back(fmt::format("the name {} is cut to 32 characters", printable(column.name_in_file)));
    const std::vector<std::byte> entry = describe_attribute(extra_type_code(column.type), name, "");
    entries_.insert(entries_.end(), entry.begin(), entry.end());
    names_.push_back(name);
    extras_.push_back({column.type, record_bytes_, i});
    record_bytes_ += size_bytes(column.type);
  }
  if (!left_out.empty()) warnings_.push_back(fmt::format("too many attributes for LAS; left out: {}", left_out));
}

void LasConversion::fill(std::size_t input, std::span<const double> values, std::span<const std::byte> original,
                         std::byte* record) {
  for (Stored& stored : fields_) {
    if (!columns_.has(input, stored.column)) continue;
    if (!store_field(stored.field, values[stored.column], record)) ++stored.clamped;
  }
  // A point whose file does not number returns is the only one of its pulse.
  const bool numbered = number_column_ >= 0 && columns_.has(input, static_cast<std::size_t>(number_column_));
  const bool counted = returns_column_ >= 0 && columns_.has(input, static_cast<std::size_t>(returns_column_));
  if (!numbered || !counted) {
    const unsigned bits = is_extended_format(point_format_) ? 4 : 3;
    unsigned byte = static_cast<unsigned>(record[14]);
    const unsigned mask = (1U << bits) - 1;
    if (!numbered) byte = (byte & ~mask) | 1U;
    if (!counted) byte = (byte & ~(mask << bits)) | (std::max(1U, byte & mask) << bits);
    record[14] = static_cast<std::byte>(byte);
  }
  for (const Extra& extra : extras_) store_scalar(extra.type, values[extra.column], record + extra.offset);
  if (verbatim_bytes_ > 0) {
    std::memcpy(record + record_bytes_ - verbatim_bytes_,
                original.data() + input_record_bytes_[input] - verbatim_bytes_, verbatim_bytes_);
  }
}

std::vector<std::string> LasConversion::clamped() const {
  std::vector<std::string> lines;
  for (const Stored& stored : fields_) {
    if (stored.clamped == 0) continue;
    lines.push_back(fmt::format("{} values of {} do not fit the field of LAS and are rounded or cut to its range",
                                grouped(stored.clamped), stored.field.name));
  }
  return lines;
}

}  // namespace arris::io
