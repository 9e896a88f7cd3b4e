#include <cstring>

#include "core/error.h"
#include "fuzz_checks.h"
#include "fuzz_entries.h"
#include "io/las_file.h"

namespace arris::test {
namespace {

/// The records delivered must be the bytes of the file, and the integers those of the records.
void require_raw_points(FuzzBytes bytes) {
  const auto file = file_of(bytes);
  const io::LasFile las = io::read_las_file(*file, io::Tolerance::kSalvage);
  const auto source = io::open_point_source(file, io::Tolerance::kSalvage);
  io::PointBatch batch;
  io::ReadOptions options;
  options.records = true;
  const std::uint8_t* at = bytes.data() + las.header.offset_to_points;
  while (source->read(batch, options)) {
    require(std::memcmp(batch.records.data(), at, batch.records.size()) == 0, "records are not the file's bytes");
    for (std::size_t i = 0; i < batch.count; ++i) {
      const std::int32_t stored[3] = {batch.ix[i], batch.iy[i], batch.iz[i]};
      require(std::memcmp(stored, at + i * las.header.record_bytes, sizeof stored) == 0, "coordinates");
    }
    at += batch.records.size();
  }
}

}  // namespace

void fuzz_las_points(FuzzBytes bytes) {
  require_consistent_readings(bytes);
  try {
    if (bytes.size() >= 4 && std::memcmp(bytes.data(), "LASF", 4) == 0) require_raw_points(bytes);
  } catch (const InputError& error) {
    require_refusal(error.what());
  }
}

}  // namespace arris::test
