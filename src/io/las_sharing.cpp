#include "io/las_sharing.h"

#include <fmt/format.h>

#include <tuple>

#include "io/bytes.h"
#include "io/input_file.h"
#include "io/kept_writers.h"
#include "io/las_extra_bytes.h"
#include "io/las_file.h"
#include "io/las_layout.h"

namespace arris::io {
namespace {

using CrsRecord = std::tuple<std::uint16_t, std::vector<std::byte>>;

struct Shared {
  LasFile las;
  std::vector<std::byte> extra_entries;
  std::vector<CrsRecord> crs;
};

Shared read_shared(const SourceInfo& input) {
  constexpr std::size_t kMostCrsBytes = std::size_t{1} << 20;
  const InputFile file(input.path);
  Shared shared{read_las_file(file, input.tolerance), {}, {}};
  shared.extra_entries = read_extra_bytes(file, shared.las).entries;
  for (const auto* records : {&shared.las.vlrs, &shared.las.evlrs}) {
    for (const LasVlr& record : *records) {
      if (is_crs_record(record)) shared.crs.emplace_back(record.record_id, read_payload(file, record, kMostCrsBytes));
    }
  }
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
  const bool waves = kLasPointLayouts[x.point_format].waveform != 0;
  const bool internal = ((x.global_encoding | y.global_encoding) & kEncodingInternalWaveforms) != 0;
  if (waves && internal) return "both may have waveforms, which are found by their place in the file";
  return {};
}

}  // namespace

void check_las_sharing(const std::vector<SourceInfo>& inputs, std::vector<std::string>& warnings) {
  if (inputs.size() < 2) return;
  const Shared first = read_shared(inputs[0]);
  bool crs_differ = false;
  std::size_t left_out = 0;
  for (std::size_t i = 1; i < inputs.size(); ++i) {
    const Shared other = read_shared(inputs[i]);
    const std::string reason = difference(first, other);
    if (!reason.empty()) refuse_sharing(inputs[0], inputs[i], reason);
    crs_differ = crs_differ || other.crs != first.crs;
    for (const LasVlr& record : other.las.evlrs) left_out += is_crs_record(record) ? 0 : 1;
  }
  const std::string name = InputFile(inputs[0].path).name();
  if (crs_differ) {
    warnings.push_back(
        fmt::format("the inputs have different coordinate reference systems; that of {} is written", name));
  }
  if (left_out > 0) {
    warnings.push_back(fmt::format("{} extended records of inputs after {} are left out", left_out, name));
  }
}

}  // namespace arris::io
