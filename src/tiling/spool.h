#pragma once
/// @file Spool files: the points of a tile as they arrived, packed, between pass 2 and the tile store.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "core/lattice.h"

namespace arris::tiling {

/// A record is x, y, z (int32) and id (uint64) in the machine's byte order, without padding.
constexpr std::size_t kSpoolRecordBytes = 20;

std::filesystem::path spool_path(const std::filesystem::path& folder, std::size_t tile);

/// Appends records to one file per tile through a fixed pool of blocks: no memory beyond the pool and 32 bytes per
/// tile, few files open at a time. When the pool is empty, the fullest block is written out. Every system call is
/// checked: IoError with the file, the reason, and for a full disk the bytes still needed and free. Not thread-safe.
class SpoolWriter {
 public:
  struct Limits {
    std::size_t buffer_bytes = 16 * 1024 * 1024;  ///< Of the pool; at least one record is always held.
    std::size_t open_files = 64;                  ///< >= 1.
    std::uint64_t expected_bytes = 0;             ///< Predicted total, for the message of a full disk.
  };
  SpoolWriter(std::filesystem::path folder, std::size_t tiles, const Limits& limits);
  ~SpoolWriter();
  SpoolWriter(const SpoolWriter&) = delete;
  SpoolWriter& operator=(const SpoolWriter&) = delete;

  /// Appends points with ids first_id, first_id + 1, ... A file left by an earlier run is replaced by the first write.
  void append(std::size_t tile, std::span<const LatticePoint> points, std::uint64_t first_id);
  /// Writes what is buffered for the tile and closes its file, which exists then even if it is empty. Call once per
  /// tile.
  void close(std::size_t tile);
  std::uint64_t records() const { return records_; }

 private:
  struct Tile {
    std::uint32_t block = kNone;
    std::uint32_t used = 0;  // Records in the block.
    int descriptor = -1;
    bool created = false;
  };
  static constexpr std::uint32_t kNone = 0xffffffffU;

  void acquire_block(std::size_t tile);
  void flush(std::size_t tile);
  int open_file(std::size_t tile);
  void close_file(std::size_t tile);
  [[noreturn]] void fail(std::size_t tile, const char* what, int reason) const;

  std::filesystem::path folder_;
  Limits limits_;
  std::uint32_t block_records_;
  std::vector<Tile> tiles_;
  std::unique_ptr<std::byte[]> pool_;
  std::vector<std::uint32_t> free_blocks_;
  std::vector<std::size_t> block_owner_;  // Per block; meaningless for free ones.
  std::vector<std::size_t> open_tiles_;   // Oldest first.
  std::uint64_t records_ = 0;
  std::uint64_t written_bytes_ = 0;
};

/// Reads a spool file back. Throws IoError if it cannot be read or is not a whole number of records.
void read_spool(const std::filesystem::path& path, std::vector<LatticePoint>& positions,
                std::vector<std::uint64_t>& ids);

}  // namespace arris::tiling
