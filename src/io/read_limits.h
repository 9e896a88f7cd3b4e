#pragma once
/// @file How readers bound and prepare their batches.

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "io/point_source.h"

namespace arris::io {

/// Most record bytes of one batch.
inline constexpr std::size_t kBatchBytes = std::size_t{4} << 20;
/// Bytes asked of the system at once where the records themselves are not kept: they are decoded while in the cache.
inline constexpr std::size_t kReadBlockBytes = std::size_t{256} << 10;

/// Points of the next batch of records of fixed size.
inline std::size_t batch_count(std::size_t batch_points, std::uint64_t points_left, std::size_t record_bytes) {
  const std::size_t by_bytes = std::max<std::size_t>(1, kBatchBytes / record_bytes);
  const std::size_t most = std::min(std::max<std::size_t>(1, batch_points), by_bytes);
  return static_cast<std::size_t>(std::min<std::uint64_t>(most, points_left));
}

/// Makes room for batch.count records of fixed size and numbers them, or empties them if they are not wanted.
inline void prepare_records(PointBatch& batch, bool wanted, std::size_t record_bytes) {
  if (!wanted) {
    batch.records.clear();
    batch.record_begin.clear();
    return;
  }
  batch.records.resize(batch.count * record_bytes);
  batch.record_begin.resize(batch.count + 1);
  for (std::size_t i = 0; i <= batch.count; ++i) batch.record_begin[i] = i * record_bytes;
}

}  // namespace arris::io
