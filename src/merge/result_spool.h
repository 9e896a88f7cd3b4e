#pragma once
/// @file Collects the partial results of all tiles and hands them back in the order of ids, combined.

#include <array>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <span>
#include <vector>

#include "core/pages.h"
#include "features/contour/contour_record.h"

namespace arris::merge {

/// The combined result of one point; classes == 0 means that it is no contour point.
struct PointResult {
  float gap_deg = 0.0F;
  float fold_strength = 0.0F;
  float fold_angle_deg = 0.0F;
  std::uint32_t votes = 0;
  std::uint8_t classes = 0;
  float score = 0.0F;
  std::array<float, 3> to_edge{0.0F, 0.0F, 0.0F};

  ContourRecord record(std::uint64_t id) const {
    return {id, classes, votes, gap_deg, fold_strength, fold_angle_deg, score, to_edge};
  }
};

/// Records are appended to one file per range of ids (a bucket). A bucket is read back as a dense array into which its
/// records are combined; combining is commutative, so nothing depends on the order in which tiles finish. Memory: one
/// bucket at a time, kBucketPoints * sizeof(PointResult) = 18 MiB. Temporary disk: see encode_results().
class ResultSpool {
 public:
  static constexpr std::uint64_t kBucketPoints = 1U << 19;

  /// @param points  ids are in [0, points).
  ResultSpool(std::filesystem::path folder, std::uint64_t points);

  /// Adds records in any order. Thread-safe. Throws IoError.
  void append(ContourRecords records);

  std::size_t buckets() const { return buckets_.size(); }
  /// Combines a bucket into `results`, indexed by id - bucket * kBucketPoints, and removes its file. Call once per
  /// bucket, after the last append. Throws IoError if the file is not what was written.
  void load(std::size_t bucket, PageVector<PointResult>& results);

  std::uint64_t bytes_on_disk() const { return bytes_on_disk_; }

 private:
  struct Bucket {
    std::uint64_t records = 0;
    std::uint64_t checksum = 0;  ///< Sum of the XXH3 of the runs: independent of their order.
  };
  std::filesystem::path bucket_path(std::size_t bucket) const;

  std::filesystem::path folder_;
  std::uint64_t points_;
  std::mutex mutex_;
  std::vector<Bucket> buckets_;
  std::uint64_t bytes_on_disk_ = 0;
};

}  // namespace arris::merge
