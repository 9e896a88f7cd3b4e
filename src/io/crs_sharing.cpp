#include "io/crs_sharing.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "io/las_crs.h"
#include "io/las_file.h"

namespace arris::io {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 20;

/// What tells systems apart. Citations are left out: programs word them differently.
struct CrsKey {
  std::string wkt;
  std::string keys;
  std::string name;  ///< For messages.
  bool empty() const { return wkt.empty() && keys.empty(); }
};

std::string payload_text(const InputFile& file, const LasVlr& record) {
  const std::vector<std::byte> bytes = read_payload(file, record, kMostBytes);
  std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  while (!text.empty() && text.back() == '\0') text.pop_back();
  return text;
}

CrsKey read_key(const SourceInfo& input) {
  CrsKey key;
  if (input.format != Format::kLas) return key;
  const InputFile file(input.path);
  const LasFile las = read_las_file(file, input.tolerance);
  for (const auto* records : {&las.vlrs, &las.evlrs}) {
    for (const LasVlr& record : *records) {
      if (record.is("LASF_Projection", 2112)) key.wkt += payload_text(file, record);
      if (record.is("LASF_Projection", 34735) || record.is("LASF_Projection", 34736))
        key.keys += payload_text(file, record);
    }
  }
  key.name = describe_crs(file, las).name;
  return key;
}

}  // namespace

void check_crs_sharing(const KeptJob& job, std::vector<std::string>& warnings) {
  if (job.inputs.size() < 2) return;
  CrsKey first;
  const SourceInfo* first_input = nullptr;
  std::size_t without = 0;
  bool unlike = false;
  for (const SourceInfo& input : job.inputs) {
    CrsKey key = read_key(input);
    if (key.empty()) {
      ++without;
    } else if (first_input == nullptr) {
      first = std::move(key);
      first_input = &input;
    } else if (!first.wkt.empty() && !key.wkt.empty()
                   ? first.wkt != key.wkt
                   : !first.keys.empty() && !key.keys.empty() && first.keys != key.keys) {
      if (!job.options.mixed_crs) {
        throw ConfigError(fmt::format(
            "{} and {} have different coordinate reference systems ({}; {}): reproject one of them, or say --mixed-crs",
            printable(first_input->path.string(), 1000), printable(input.path.string(), 1000),
            first.name.empty() ? "unnamed" : first.name, key.name.empty() ? "unnamed" : key.name));
      }
      unlike = true;
    } else if (first.wkt.empty() != key.wkt.empty()) {
      unlike = true;
    }
  }
  if (first_input == nullptr) return;
  const std::string name = printable(first_input->path.string(), 1000);
  if (unlike) {
    warnings.push_back(
        fmt::format("the inputs name their coordinate reference systems differently; that of {} is written", name));
  }
  if (without > 0) {
    warnings.push_back(
        fmt::format("{} of {} inputs name no coordinate reference system; that of {} is taken for theirs", without,
                    job.inputs.size(), name));
  }
}

}  // namespace arris::io
