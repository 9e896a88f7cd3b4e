#include "io/las_sharing.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/bytes.h"
#include "io/input_file.h"
#include "io/las_extra_bytes.h"
#include "io/las_file.h"
#include "io/las_layout.h"

namespace arris::io {
namespace {

struct Shared {
  LasFile las;
  std::vector<std::byte> extra_entries;
  std::size_t extra_bytes = 0;
};

Shared read_shared(const SourceInfo& input) {
  const InputFile file(input.path);
  Shared shared{read_las_file(file, input.tolerance), {}, 0};
  ExtraBytes extra = read_extra_bytes(file, shared.las);
  shared.extra_entries = std::move(extra.entries);
  shared.extra_bytes = extra.present_bytes;
  return shared;
}

std::string triple(const std::array<double, 3>& v) {
  return fmt::format("({}, {}, {})", v[0], v[1], v[2]);
}

std::string difference(const Shared& a, const Shared& b) {
  const LasHeader& x = a.las.header;
  const LasHeader& y = b.las.header;
  if (x.point_format != y.point_format) return fmt::format("point formats {} and {}", x.point_format, y.point_format);
  if (x.record_bytes != y.record_bytes) return fmt::format("record lengths {} and {}", x.record_bytes, y.record_bytes);
  if (x.scale != y.scale) return fmt::format("scales {} and {}", triple(x.scale), triple(y.scale));
  if (x.offset != y.offset) return fmt::format("offsets {} and {}", triple(x.offset), triple(y.offset));
  if (a.extra_entries != b.extra_entries) return "different descriptions of extra bytes";
  constexpr std::uint16_t kGpsTimeType = 1;
  if (((x.global_encoding ^ y.global_encoding) & kGpsTimeType) != 0) return "GPS week time and adjusted GPS time";
  const bool waves = kLasPointLayouts[x.point_format].waveform != 0;
  const bool internal = ((x.global_encoding | y.global_encoding) & kEncodingInternalWaveforms) != 0;
  if (waves && internal) return "both may have waveforms, which are found by their place in the file";
  return {};
}

}  // namespace

std::string las_difference(const std::vector<SourceInfo>& inputs) {
  if (inputs.size() < 2) return {};
  const Shared first = read_shared(inputs[0]);
  for (std::size_t i = 1; i < inputs.size(); ++i) {
    const std::string reason = difference(first, read_shared(inputs[i]));
    if (!reason.empty()) return reason;
  }
  return {};
}

bool same_extra_bytes(const std::vector<SourceInfo>& inputs) {
  const Shared first = read_shared(inputs.at(0));
  return std::all_of(inputs.begin() + 1, inputs.end(), [&](const SourceInfo& input) {
    const Shared other = read_shared(input);
    return other.extra_bytes == first.extra_bytes && other.extra_entries == first.extra_entries;
  });
}

std::size_t later_extended_records(const std::vector<SourceInfo>& inputs) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < inputs.size(); ++i) {
    const InputFile file(inputs[i].path);
    for (const LasVlr& record : read_las_file(file, inputs[i].tolerance).evlrs) count += is_crs_record(record) ? 0 : 1;
  }
  return count;
}

}  // namespace arris::io
