#pragma once
/// @file Reads the combined results of a spool point by point, in the order of ids.

#include "core/error.h"
#include "core/pages.h"
#include "merge/result_spool.h"

namespace arris::merge {

/// Ids must not descend. Holds one bucket. Not thread-safe.
class ResultReader {
 public:
  explicit ResultReader(ResultSpool& spool) : spool_(spool) {}

  /// Throws InputError for ids that the spool was not made for.
  ContourRecord at(std::uint64_t id) {
    const auto wanted = static_cast<std::size_t>(id / ResultSpool::kBucketPoints);
    if (wanted != bucket_index_) {
      if (wanted >= spool_.buckets())
        throw InputError("the inputs grew while they were read; run again when they are complete");
      spool_.load(wanted, bucket_);
      bucket_index_ = wanted;
    }
    return bucket_[id % ResultSpool::kBucketPoints].record(id);
  }

 private:
  ResultSpool& spool_;
  std::size_t bucket_index_ = static_cast<std::size_t>(-1);
  PageVector<PointResult> bucket_;
};

}  // namespace arris::merge
