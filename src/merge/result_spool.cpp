#include "merge/result_spool.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/error.h"
#include "core/file_descriptor.h"

namespace arris::merge {
namespace {

/// ContourRecord on disk: no padding bytes whose content would be undefined.
struct DiskRecord {
  std::uint64_t id;
  std::uint32_t votes;
  float gap_deg;
  float fold_strength;
  float fold_angle_deg;
  std::uint32_t classes;
  float score;
  float to_edge[3];
  std::uint32_t reserved;
};
static_assert(sizeof(DiskRecord) == 48);

std::uint64_t checksum(std::span<const DiskRecord> records) {
  std::uint64_t sum = 0;
  for (const DiskRecord& record : records) sum += XXH3_64bits(&record, sizeof record);
  return sum;
}

}  // namespace

ResultSpool::ResultSpool(std::filesystem::path folder, std::uint64_t points)
    : folder_(std::move(folder)), points_(points), buckets_((points + kBucketPoints - 1) / kBucketPoints) {}

std::filesystem::path ResultSpool::bucket_path(std::size_t bucket) const {
  return folder_ / fmt::format("{}.results", bucket);
}

void ResultSpool::append(ContourRecords records) {
  std::sort(records.begin(), records.end(), [](const ContourRecord& a, const ContourRecord& b) { return a.id < b.id; });
  PageVector<DiskRecord> run;
  for (std::size_t begin = 0; begin < records.size();) {
    const std::size_t bucket = static_cast<std::size_t>(records[begin].id / kBucketPoints);
    if (records[begin].id >= points_) throw IoError("a tile produced a result for a point that does not exist");
    std::size_t end = begin;
    run.clear();
    for (; end < records.size() && records[end].id / kBucketPoints == bucket; ++end) {
      const ContourRecord& r = records[end];
      run.push_back({r.id,
                     r.votes,
                     r.gap_deg,
                     r.fold_strength,
                     r.fold_angle_deg,
                     r.classes,
                     r.score,
                     {r.to_edge[0], r.to_edge[1], r.to_edge[2]},
                     0});
    }
    const std::uint64_t sum = checksum(run);
    {
      const std::lock_guard lock(mutex_);
      const FileDescriptor file = FileDescriptor::open(bucket_path(bucket), O_WRONLY | O_CREAT | O_APPEND);
      file.write_all(std::as_bytes(std::span(run)));
      buckets_[bucket].records += run.size();
      buckets_[bucket].checksum += sum;
      bytes_on_disk_ += run.size() * sizeof(DiskRecord);
    }
    begin = end;
  }
}

void ResultSpool::load(std::size_t bucket, PageVector<PointResult>& results) {
  const std::uint64_t first_id = bucket * kBucketPoints;
  results.assign(std::min(kBucketPoints, points_ - first_id), PointResult{});
  const Bucket& expected = buckets_.at(bucket);
  if (expected.records == 0) return;
  const std::filesystem::path path = bucket_path(bucket);
  const FileDescriptor file = FileDescriptor::open(path, O_RDONLY);
  std::uint64_t records = 0;
  std::uint64_t sum = 0;
  PageVector<DiskRecord> block(32 * 1024);
  for (;;) {
    const std::size_t bytes = file.read_some(std::as_writable_bytes(std::span(block)));
    const std::span<const DiskRecord> read(block.data(), bytes / sizeof(DiskRecord));
    sum += checksum(read);
    records += read.size();
    for (const DiskRecord& r : read) {
      if (r.id < first_id || r.id - first_id >= results.size()) continue;  // Damage: the checksum below will not match.
      PointResult& to = results[r.id - first_id];
      ContourRecord combined = to.record(r.id);
      combine(combined, {r.id,
                         static_cast<std::uint8_t>(r.classes),
                         r.votes,
                         r.gap_deg,
                         r.fold_strength,
                         r.fold_angle_deg,
                         r.score,
                         {r.to_edge[0], r.to_edge[1], r.to_edge[2]}});
      to = {combined.gap_deg, combined.fold_strength, combined.fold_angle_deg, combined.votes,
            combined.classes, combined.score,         combined.to_edge};
    }
    if (bytes < block.size() * sizeof(DiskRecord)) break;
  }
  if (records != expected.records || sum != expected.checksum) {
    throw IoError(fmt::format(
        "{}: temporary results were damaged on disk ({} records, {} expected); run again, and check the disk",
        path.string(), records, expected.records));
  }
  std::filesystem::remove(path);
}

}  // namespace arris::merge
