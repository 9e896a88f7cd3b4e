#pragma once
/// @file The points near the borders of segments, with their neighbours' ids, on disk.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <span>

#include "core/lattice.h"
#include "merge/point_labels.h"
#include "tiling/scratch_file.h"

namespace arris::merge {

/// One record of TileGrowth::frontier.
struct FrontierPoint {
  std::uint32_t id = 0;
  LatticePoint position;
  std::span<const std::uint32_t> neighbours;  ///< Ids.
};

/// Appended in any order, then cut down to the border, then read as often as wanted. Disk: words as differences in as
/// few bytes as they need: 2 to 3 each where neighbours in space have ids near each other. Memory: a block of records
/// while reading.
class SegmentFrontier {
 public:
  /// @param most_neighbours  k of the records.
  SegmentFrontier(std::filesystem::path file, std::size_t most_neighbours);

  /// TileGrowth::frontier. Thread-safe.
  void append(std::span<const std::uint32_t> words);

  /// Drops the points all of whose neighbours are in the point's own segment. Which of those the tiles appended depends
  /// on how the scan was cut; what is left does not.
  /// @return the most bytes that were on disk meanwhile.
  std::uint64_t keep_border(const PointLabels& labels);

  /// Calls use(records as words) block by block, in the order of the file.
  void for_each_block(const std::function<void(std::span<const std::uint32_t> words)>& use) const;

  /// @param words  of one block. @param index  of the record in it.
  FrontierPoint point(std::span<const std::uint32_t> words, std::size_t index) const;
  std::size_t stride() const { return stride_; }
  std::uint64_t records() const { return records_; }
  std::uint64_t bytes_on_disk() const { return file_->bytes_on_disk(); }

 private:
  /// Calls use(records as words, offset of what follows in the file).
  void read_blocks(const std::function<void(std::span<const std::uint32_t> words, std::uint64_t offset)>& use) const;

  std::size_t stride_;
  std::mutex mutex_;
  std::filesystem::path path_;
  std::unique_ptr<tiling::ScratchFile> file_;
  std::uint64_t records_ = 0;
};

}  // namespace arris::merge
