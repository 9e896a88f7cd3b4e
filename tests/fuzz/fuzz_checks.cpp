#include "fuzz_checks.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>
#include <string>

#include "core/error.h"
#include "io/point_statistics.h"

namespace arris::test {
namespace {

bool is_printable(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= 0x20 && c <= 0x7e; });
}

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  return (std::rotl(hash, 5) ^ value) * 0x9e3779b97f4a7c15ULL;
}

void require_batch(const io::PointBatch& batch, const io::SourceInfo& info, bool records) {
  require(batch.count > 0, "an empty batch");
  const std::size_t stored = info.scaled_integers ? batch.count : 0;
  const std::size_t world = batch.count - stored;
  require(batch.ix.size() == stored && batch.iy.size() == stored && batch.iz.size() == stored, "stored coordinates");
  require(batch.x.size() == world && batch.y.size() == world && batch.z.size() == world, "world coordinates");
  if (!records) return;
  require(batch.record_begin.size() == batch.count + 1, "number of records");
  require(batch.record_begin.front() == 0 && batch.record_begin.back() == batch.records.size(), "ends of records");
  require(std::is_sorted(batch.record_begin.begin(), batch.record_begin.end()), "order of records");
}

void add_coordinates(const io::PointBatch& batch, bool scaled_integers, std::uint64_t& hash) {
  for (std::size_t i = 0; i < batch.count; ++i) {
    if (scaled_integers) {
      for (const auto* axis : {&batch.ix, &batch.iy, &batch.iz})
        hash = mixed(hash, static_cast<std::uint64_t>((*axis)[i]));
    } else {
      for (const auto* axis : {&batch.x, &batch.y, &batch.z})
        hash = mixed(hash, std::bit_cast<std::uint64_t>((*axis)[i]));
    }
  }
}

/// The points as numbers: as many of them, for every reader of the same bytes.
void require_statistics(const std::shared_ptr<const io::InputFile>& file, io::Tolerance tolerance,
                        std::uint64_t points) {
  const auto source = io::open_point_source(file, tolerance);
  const auto reader = io::make_record_reader(*file, source->info());
  const io::PointStatistics statistics = io::collect_statistics(*source, *reader, [](std::uint64_t) {});
  require(statistics.points == points, "points counted as numbers");
  for (const io::ColumnStatistics& column : statistics.columns)
    require(column.finite + column.not_finite == points, "values of a column");
  require_problems(io::find_point_problems(*file, source->info(), statistics));
}

}  // namespace

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

std::shared_ptr<const io::InputFile> file_of(FuzzBytes bytes) {
  std::vector<std::byte> copy(bytes.size());
  if (!bytes.empty()) std::memcpy(copy.data(), bytes.data(), bytes.size());
  return io::InputFile::in_memory("f", std::move(copy));
}

void require_refusal(std::string_view message) {
  require(is_printable(message), "a refusal with control characters");
  require(message.starts_with("f: byte ") && message.size() < 1000, "a refusal without its place");
  const std::size_t colon = message.find(": ", 8);
  const std::string_view digits = message.substr(8, colon - 8);
  require(!digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos, "a refusal's byte");
  require(message.find("; ", colon) != std::string_view::npos, "a refusal without advice");
}

void require_problems(const std::vector<io::Problem>& problems) {
  for (const io::Problem& problem : problems) {
    require(!problem.code.empty() && is_printable(problem.code), "code of a problem");
    require(!problem.text.empty() && problem.text.size() < 1000 && is_printable(problem.text), "text of a problem");
  }
}

Reading read_points(const std::shared_ptr<const io::InputFile>& file, io::Tolerance tolerance,
                    const io::ReadOptions& options) {
  Reading reading;
  try {
    const auto source = io::open_point_source(file, tolerance);
    reading.opened = true;
    require_problems(source->info().problems);
    require(source->info().points <= file->size_bytes(), "more points than bytes");
    io::PointBatch batch;
    while (source->read(batch, options)) {
      require(batch.count <= options.batch_points, "too large a batch");
      require(batch.first_id == reading.points, "first_id");
      require_batch(batch, source->info(), options.records);
      add_coordinates(batch, source->info().scaled_integers, reading.hash);
      reading.points += batch.count;
    }
    require(reading.points == source->info().points, "points promised");
  } catch (const InputError& error) {
    reading.message = error.what();
    require_refusal(reading.message);
    reading.refused = true;
  }
  return reading;
}

void require_consistent_readings(FuzzBytes bytes) {
  const auto file = file_of(bytes);
  io::ReadOptions few;
  few.records = true;
  few.batch_points = 1 + bytes.size() % 5;
  const Reading usual = read_points(file, io::Tolerance::kUsual, few);
  const Reading salvage = read_points(file, io::Tolerance::kSalvage, few);
  const Reading strict = read_points(file, io::Tolerance::kStrict, few);
  if (!strict.refused) require(!usual.refused && strict.hash == usual.hash, "strict reads more");
  if (!usual.refused) require(!salvage.refused && salvage.points >= usual.points, "salvage reads less");
  if (salvage.refused) {
    const bool out_of_step = salvage.message.find("values remain after vertex") != std::string::npos;
    require(!salvage.opened || out_of_step, "salvage promises what it cannot read");
    return;
  }
  const Reading many = read_points(file, io::Tolerance::kSalvage, {});
  require(!many.refused && many.points == salvage.points && many.hash == salvage.hash, "batches change the points");
  require_statistics(file, io::Tolerance::kSalvage, salvage.points);
}

}  // namespace arris::test
