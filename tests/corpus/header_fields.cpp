#include <algorithm>
#include <cstdio>

#include "../io/las_builder.h"
#include "strip.h"

namespace arris::test {
namespace {

enum class Kind { kCount32, kCount64, kDouble };

struct Field {
  const char* name;
  std::size_t at;
  Kind kind;
  std::size_t values = 1;
  int since_minor = 0;
  std::size_t size_bytes() const { return values * (kind == Kind::kCount32 ? 4 : 8); }
};

/// Fields that follow from the points.
const std::vector<Field> kFields{
    {"vlr-count", 100, Kind::kCount32},
    {"legacy-count", 107, Kind::kCount32},
    {"legacy-by-return", 111, Kind::kCount32, 5},
    {"max-x", 179, Kind::kDouble},
    {"min-x", 187, Kind::kDouble},
    {"max-y", 195, Kind::kDouble},
    {"min-y", 203, Kind::kDouble},
    {"max-z", 211, Kind::kDouble},
    {"min-z", 219, Kind::kDouble},
    {"count", 247, Kind::kCount64, 1, 4},
    {"by-return", 255, Kind::kCount64, 15, 4},
};

std::string name_at(std::size_t byte, int minor) {
  for (const Field& field : kFields) {
    if (byte >= field.at && byte < field.at + field.size_bytes() && minor >= field.since_minor) return field.name;
  }
  return "byte " + std::to_string(byte);
}

}  // namespace

std::set<std::string> differing_fields(const std::string& a, const std::string& b) {
  std::set<std::string> fields;
  if (a.size() != b.size()) fields.insert("size");
  const std::size_t header_bytes = get<std::uint16_t>(a, 94);
  for (std::size_t byte = 0; byte < std::min({header_bytes, a.size(), b.size()}); ++byte) {
    if (a[byte] != b[byte]) fields.insert(name_at(byte, a[25]));
  }
  if (a.substr(header_bytes) != b.substr(header_bytes)) fields.insert("body");
  return fields;
}

std::string field_value(const std::string& las, const std::string& name) {
  const auto field = std::find_if(kFields.begin(), kFields.end(), [&](const Field& f) { return name == f.name; });
  if (field == kFields.end()) return {};
  std::string text;
  for (std::size_t i = 0; i < field->values; ++i) {
    if (i > 0) text += '/';
    if (field->kind == Kind::kCount32) text += std::to_string(get<std::uint32_t>(las, field->at + 4 * i));
    if (field->kind == Kind::kCount64) text += std::to_string(get<std::uint64_t>(las, field->at + 8 * i));
    if (field->kind == Kind::kDouble) {
      char digits[40];
      std::snprintf(digits, sizeof digits, "%.17g", get<double>(las, field->at));
      text += digits;
    }
  }
  return text;
}

}  // namespace arris::test
