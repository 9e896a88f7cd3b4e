#pragma once
/// @file The output of peers that label points: the whole scan with a column more, for arris evaluate.

#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "io/point_writer.h"

namespace arris::bench {

/// @param path  .las or .ply; replaced if it exists. @param labels  of every point of the scan, in order.
inline void write_labels(const std::string& scan, const std::string& path, const ColumnSpec& column,
                         std::span<const std::uint32_t> labels) {
  io::InputSet inputs({scan});
  const auto writer = io::create_kept_point_writer(path, inputs, {column}, {.overwrite = true, .every_point = true});
  io::ReadOptions options;
  options.records = true;
  std::vector<std::uint32_t> kept;
  for (io::PointBatch batch; inputs.read(batch, options);) {
    kept.resize(batch.count);
    std::iota(kept.begin(), kept.end(), 0U);
    writer->append(inputs.source_index(), batch, kept, std::as_bytes(labels.subspan(batch.first_id, batch.count)));
  }
  writer->commit();
}

}  // namespace arris::bench
