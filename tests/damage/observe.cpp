#include "observe.h"

#include <algorithm>
#include <cstring>
#include <functional>

#include "core/error.h"
#include "io/file_summary.h"
#include "io/point_statistics.h"

namespace arris::test {
namespace {

/// A batch must be as its description says: counts, ids, records in order and within their bytes.
void check_batch(const io::PointBatch& batch, const io::SourceInfo& info, bool records, Observed& observed) {
  const auto expect = [&](bool holds, const char* what) {
    if (!holds) observed.contradictions.emplace_back(what);
  };
  expect(batch.count > 0, "an empty batch was delivered");
  const std::size_t stored = info.scaled_integers ? batch.count : 0;
  expect(batch.ix.size() == stored && batch.iy.size() == stored && batch.iz.size() == stored, "stored coordinates");
  const std::size_t world = info.scaled_integers ? 0 : batch.count;
  expect(batch.x.size() == world && batch.y.size() == world && batch.z.size() == world, "world coordinates");
  if (!records) return;
  expect(batch.record_begin.size() == batch.count + 1 && batch.record_begin.front() == 0 &&
             batch.record_begin.back() == batch.records.size(),
         "borders of records");
  for (std::size_t i = 0; i + 1 < batch.record_begin.size(); ++i)
    expect(batch.record_begin[i] < batch.record_begin[i + 1], "an empty record");
}

std::uint64_t read_all(io::PointSource& source, const io::ReadOptions& options, Observed& observed) {
  io::PointBatch batch;
  std::uint64_t points = 0;
  source.rewind();
  while (source.read(batch, options)) {
    check_batch(batch, source.info(), options.records, observed);
    if (batch.first_id != points) observed.contradictions.emplace_back("first_id");
    points += batch.count;
  }
  if (batch.count != 0) observed.contradictions.emplace_back("points behind the end");
  return points;
}

Observed refusal_of(const std::function<void(Observed&)>& action) {
  Observed observed;
  try {
    action(observed);
  } catch (const InputError& error) {
    observed.refused = true;
    observed.message = error.what();
  }
  return observed;
}

}  // namespace

Observed observe(const std::shared_ptr<const io::InputFile>& file, io::Tolerance tolerance) {
  return refusal_of([&](Observed& observed) {
    const io::FileSummary summary = io::summarize_file(file, tolerance);
    observed.problems = summary.problems;
    const auto source = io::open_point_source(file, tolerance);
    io::ReadOptions few;
    few.records = true;
    few.batch_points = 3;
    observed.points = read_all(*source, few, observed);
    if (read_all(*source, {}, observed) != observed.points) observed.contradictions.emplace_back("points read twice");
    // Some faults show only once the points have been read.
    const auto& known = summary.problems;
    for (const io::Problem& problem : source->info().problems) {
      const bool repeated = std::any_of(known.begin(), known.end(), [&](const io::Problem& other) {
        return other.code == problem.code && other.byte == problem.byte;
      });
      if (!repeated) observed.problems.push_back(problem);
    }
    const auto reader = io::make_record_reader(*file, source->info());
    const io::PointStatistics statistics = io::collect_statistics(*source, *reader, [](std::uint64_t) {});
    observed.point_problems = io::find_point_problems(*file, source->info(), statistics);
    if (observed.points != statistics.points) observed.contradictions.emplace_back("points counted");
    if (observed.points != source->info().points) observed.contradictions.emplace_back("points promised");
    if (observed.points != summary.info.points) observed.contradictions.emplace_back("points summarized");
  });
}

Observed observe_set(const std::filesystem::path& path, io::Tolerance tolerance) {
  return refusal_of([&](Observed& observed) {
    io::InputSet inputs({path}, tolerance);
    observed.problems = inputs.sources()[0].problems;
    io::PointBatch batch;
    while (inputs.read(batch, {})) observed.points += batch.count;
    if (observed.points != inputs.points()) observed.contradictions.emplace_back("points promised");
  });
}

std::shared_ptr<const io::InputFile> in_memory(const std::string& name, const std::string& bytes) {
  std::vector<std::byte> copy(bytes.size());
  if (!bytes.empty()) std::memcpy(copy.data(), bytes.data(), bytes.size());
  return io::InputFile::in_memory(name, std::move(copy));
}

}  // namespace arris::test
