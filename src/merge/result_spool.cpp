#include "merge/result_spool.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "core/file_descriptor.h"
#include "merge/result_coding.h"

namespace arris::merge {
namespace {

/// Before every run of records.
struct RunHead {
  std::uint32_t bytes = 0;  ///< Of what follows.
  std::uint32_t records = 0;
};
constexpr std::size_t kRunRecords = 8192;
/// More than a run of so many records can take.
constexpr std::size_t kMostRunBytes = 64 * kRunRecords;

void append_run(std::span<const ContourRecord> records, std::uint64_t first_id, PageVector<std::byte>& out) {
  const std::size_t begin = out.size();
  out.resize(begin + sizeof(RunHead));
  encode_results(records, first_id, out);
  const RunHead head{static_cast<std::uint32_t>(out.size() - begin - sizeof(RunHead)),
                     static_cast<std::uint32_t>(records.size())};
  std::memcpy(out.data() + begin, &head, sizeof head);
}

}  // namespace

ResultSpool::ResultSpool(std::filesystem::path folder, std::uint64_t points)
    : folder_(std::move(folder)), points_(points), buckets_((points + kBucketPoints - 1) / kBucketPoints) {}

std::filesystem::path ResultSpool::bucket_path(std::size_t bucket) const {
  return folder_ / fmt::format("{}.results", bucket);
}

void ResultSpool::append(ContourRecords records) {
  std::sort(records.begin(), records.end(), [](const ContourRecord& a, const ContourRecord& b) { return a.id < b.id; });
  PageVector<std::byte> runs;
  for (std::size_t begin = 0; begin < records.size();) {
    const std::uint64_t bucket = records[begin].id / kBucketPoints;
    if (records[begin].id >= points_) throw IoError("a tile produced a result for a point that does not exist");
    runs.clear();
    std::uint64_t sum = 0, count = 0;
    while (begin < records.size() && records[begin].id / kBucketPoints == bucket) {
      std::size_t end = begin;
      while (end < records.size() && end - begin < kRunRecords && records[end].id / kBucketPoints == bucket) ++end;
      const std::size_t run_begin = runs.size();
      append_run(std::span(records).subspan(begin, end - begin), bucket * kBucketPoints, runs);
      sum += XXH3_64bits(runs.data() + run_begin, runs.size() - run_begin);
      count += end - begin;
      begin = end;
    }
    const std::lock_guard lock(mutex_);
    const FileDescriptor file =
        FileDescriptor::open(bucket_path(static_cast<std::size_t>(bucket)), O_WRONLY | O_CREAT | O_APPEND);
    file.write_all(runs);
    Bucket& written = buckets_[static_cast<std::size_t>(bucket)];
    written.records += count;
    written.checksum += sum;
    bytes_on_disk_ += runs.size();
  }
}

void ResultSpool::load(std::size_t bucket, PageVector<PointResult>& results) {
  const std::uint64_t first_id = bucket * kBucketPoints;
  results.assign(std::min(kBucketPoints, points_ - first_id), PointResult{});
  const Bucket& expected = buckets_.at(bucket);
  if (expected.records == 0) return;
  const std::filesystem::path path = bucket_path(bucket);
  const FileDescriptor file = FileDescriptor::open(path, O_RDONLY);
  std::uint64_t count = 0, sum = 0;
  bool sound = true;
  PageVector<std::byte> run;
  ContourRecords records;
  while (sound && count < expected.records) {
    RunHead head;
    sound = file.read_some(std::as_writable_bytes(std::span(&head, 1))) == sizeof head && head.records <= kRunRecords &&
            head.bytes <= kMostRunBytes;
    if (!sound) break;
    run.resize(sizeof head + head.bytes);
    std::memcpy(run.data(), &head, sizeof head);
    const std::span<std::byte> bytes = std::span(run).subspan(sizeof head);
    sound = file.read_some(bytes) == bytes.size() && decode_results(bytes, head.records, first_id, records);
    sum += XXH3_64bits(run.data(), run.size());
    count += head.records;
    for (const ContourRecord& r : records) {
      if (r.id - first_id >= results.size()) continue;  // Damage: the checksum below will not match.
      PointResult& to = results[r.id - first_id];
      ContourRecord combined = to.record(r.id);
      combine(combined, r);
      to = {combined.gap_deg, combined.fold_strength, combined.fold_angle_deg, combined.votes,
            combined.classes, combined.score,         combined.to_edge};
    }
  }
  if (!sound || count != expected.records || sum != expected.checksum) {
    throw IoError(
        fmt::format("{}: temporary results were damaged on disk; run again, and check the disk", path.string()));
  }
  std::filesystem::remove(path);
}

}  // namespace arris::merge
