#pragma once
/// @file The points near the borders of segments, with their neighbours' ids, on disk.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <span>
#include <vector>

#include "merge/frontier_coding.h"
#include "merge/point_labels.h"
#include "tiling/scratch_file.h"

namespace arris::merge {

/// Appended in any order, then cut down to the border, then read as often as wanted. Disk: frontier_coding.h. Memory:
/// as much of the border as there is room for, of the rest a bit per record, and a few blocks while reading.
class SegmentFrontier {
 public:
  /// @param most_neighbours  k of the records.
  SegmentFrontier(std::filesystem::path file, std::size_t most_neighbours);

  /// TileGrowth::frontier. Thread-safe.
  void append(std::span<const std::uint32_t> words);

  /// Drops the points all of whose neighbours are in the point's own segment. Which of those the tiles appended depends
  /// on how the scan was cut; what is left does not. They stay on disk, being few. Call once, after the last append().
  /// Several blocks at a time, in parallel.
  /// @param most_bytes  memory that what is left may take: what does not fit is read from disk every time.
  void keep_border(const PointLabels& labels, std::uint64_t most_bytes = 0);

  /// Calls use(blocks) in turn for several blocks at a time, which have all the points together.
  void for_each_blocks(const std::function<void(std::span<const FrontierBlock> blocks)>& use) const;

  std::uint64_t records() const { return records_; }
  std::uint64_t bytes_on_disk() const { return file_.size_bytes(); }

 private:
  struct Part {
    std::uint64_t offset = 0;  ///< In the file.
    std::uint32_t bytes = 0;
    std::uint32_t records = 0;
    std::vector<bool> dropped;  ///< Empty: none.
  };
  void read(const Part& part, FrontierBlock& block) const;
  /// What keep_border() does with one part. Returns the border if it is to be kept.
  FrontierBlock drop_interior(const PointLabels& labels, Part& part, bool keeps) const;

  std::size_t stride_;
  std::mutex mutex_;
  tiling::ScratchFile file_;
  std::vector<Part> parts_;
  std::vector<FrontierBlock> kept_;  ///< The border of the first parts.
  std::uint64_t records_ = 0;
};

}  // namespace arris::merge
