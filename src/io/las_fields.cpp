#include "io/las_fields.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "io/bytes.h"
#include "io/las_layout.h"

namespace arris::io {
namespace {

constexpr ScalarType kByte = ScalarType::kUint8;
constexpr ScalarType kWord = ScalarType::kUint16;

/// Point formats 0 to 5.
void add_legacy_fields(std::vector<LasField>& fields) {
  fields.insert(fields.end(), {
                                  {"return_number", kByte, kByte, 14, 0, 7},
                                  {"number_of_returns", kByte, kByte, 14, 3, 7},
                                  {"scan_direction_flag", kByte, kByte, 14, 6, 1},
                                  {"edge_of_flight_line", kByte, kByte, 14, 7, 1},
                                  {"classification", kByte, kByte, 15, 0, 31},
                                  {"classification_flags", kByte, kByte, 15, 5, 7},
                                  {"scan_angle", ScalarType::kFloat32, ScalarType::kInt8, 16},
                                  {"user_data", kByte, kByte, 17},
                                  {"point_source_id", kWord, kWord, 18},
                              });
}

/// Point formats 6 to 10.
void add_extended_fields(std::vector<LasField>& fields) {
  fields.insert(fields.end(), {
                                  {"return_number", kByte, kByte, 14, 0, 15},
                                  {"number_of_returns", kByte, kByte, 14, 4, 15},
                                  {"classification_flags", kByte, kByte, 15, 0, 15},
                                  {"scanner_channel", kByte, kByte, 15, 4, 3},
                                  {"scan_direction_flag", kByte, kByte, 15, 6, 1},
                                  {"edge_of_flight_line", kByte, kByte, 15, 7, 1},
                                  {"classification", kByte, kByte, 16},
                                  {"user_data", kByte, kByte, 17},
                                  {"scan_angle", ScalarType::kFloat32, ScalarType::kInt16, 18, 0, 0, kScanAngleStepDeg},
                                  {"point_source_id", kWord, kWord, 20},
                              });
}

std::vector<LasField> make_fields(std::uint8_t point_format) {
  std::vector<LasField> fields{{"intensity", kWord, kWord, 12}};
  if (is_extended_format(point_format)) {
    add_extended_fields(fields);
  } else {
    add_legacy_fields(fields);
  }
  const LasPointLayout& layout = kLasPointLayouts[point_format];
  if (layout.gps_time != 0) fields.push_back({"gps_time", ScalarType::kFloat64, ScalarType::kFloat64, layout.gps_time});
  if (layout.colour != 0) {
    fields.push_back({"red", kWord, kWord, layout.colour});
    fields.push_back({"green", kWord, kWord, layout.colour + 2});
    fields.push_back({"blue", kWord, kWord, layout.colour + 4});
  }
  if (layout.infrared != 0) fields.push_back({"nir", kWord, kWord, layout.infrared});
  return fields;
}

}  // namespace

const std::vector<LasField>& las_fields(std::uint8_t point_format) {
  static const auto kAll = [] {
    std::array<std::vector<LasField>, kLasPointFormats> all;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = make_fields(static_cast<std::uint8_t>(i));
    return all;
  }();
  assert(point_format < kLasPointFormats);
  return kAll[point_format];
}

double load_field(const LasField& field, const std::byte* record) {
  if (field.mask != 0) return (load<std::uint8_t>(record + field.offset) >> field.shift) & field.mask;
  return load_scalar(field.stored, record + field.offset) * field.unit;
}

bool store_field(const LasField& field, double value, std::byte* record) {
  std::byte* at = record + field.offset;
  const double steps = value / field.unit;
  if (field.mask != 0) {
    const double most = field.mask;
    const auto bits = std::isnan(steps) ? 0U : static_cast<unsigned>(std::round(std::clamp(steps, 0.0, most)));
    const unsigned others = load<std::uint8_t>(at) & ~(field.mask << field.shift);
    store<std::uint8_t>(at, static_cast<std::uint8_t>(others | (bits << field.shift)));
  } else {
    store_scalar(field.stored, steps, at);
  }
  const double got = load_field(field, record);
  return std::abs(got - value) <= 0.5 * field.unit || (std::isnan(got) && std::isnan(value));
}

}  // namespace arris::io
