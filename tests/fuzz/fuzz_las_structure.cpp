#include <string>

#include "core/error.h"
#include "fuzz_checks.h"
#include "fuzz_entries.h"
#include "io/file_summary.h"
#include "io/las_extra_bytes.h"
#include "io/las_file.h"

namespace arris::test {
namespace {

/// Records must lie within the file, in order, and the points between them.
void require_places(const io::LasFile& las, std::uint64_t size_bytes) {
  std::uint64_t at = las.header.raw.size();
  for (const io::LasVlr& record : las.vlrs) {
    require(record.begin == at && record.end() <= las.header.offset_to_points, "place of a VLR");
    at = record.end();
  }
  require(las.vlrs_end == at, "end of the VLRs");
  require(las.points_end <= size_bytes, "end of the points");
  require(las.points_end - las.header.offset_to_points == las.points * las.header.record_bytes, "length of the points");
  for (const io::LasVlr& record : las.evlrs)
    require(record.begin >= las.header.raw.size() && record.payload <= record.end() && record.end() <= size_bytes,
            "place of an EVLR");
}

void require_extra_bytes(const io::InputFile& file, const io::LasFile& las) {
  const io::ExtraBytes extra = io::read_extra_bytes(file, las);
  require(extra.described_bytes <= extra.present_bytes, "more extra bytes described than present");
  for (const io::ExtraAttribute& attribute : extra.attributes)
    require(attribute.offset + attribute.size_bytes <= las.header.record_bytes, "place of an attribute");
}

}  // namespace

void fuzz_las_structure(FuzzBytes bytes) {
  const auto file = file_of(bytes);
  try {
    const io::LasFile las = io::read_las_file(*file, io::Tolerance::kSalvage);
    require_problems(las.problems);
    require_places(las, bytes.size());
    require_extra_bytes(*file, las);
    const io::FileSummary summary = io::summarize_file(file, io::Tolerance::kSalvage);
    require_problems(summary.problems);
    for (const std::string* text : {&summary.crs.name, &summary.crs.unit, &summary.crs.text})
      require(text->size() <= 4010, "length of the coordinate reference system");
  } catch (const InputError& error) {
    require_refusal(error.what());
  }
}

}  // namespace arris::test
