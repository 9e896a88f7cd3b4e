#pragma once
/// @file Spool files: the points of a tile as they arrived, packed, between pass 2 and the tile store.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "core/lattice.h"
#include "core/tile_points.h"
#include "tiling/packed_points.h"

namespace arris::tiling {

/// Of a file, per point: scans in the order of their lines take 7 to 9, points in any order 12 to 16.
constexpr double kSpoolBytesPerPoint = 9.0;

std::filesystem::path spool_path(const std::filesystem::path& folder, std::size_t tile);

/// Appends points to one file per tile through a fixed pool of blocks, which are packed when they are written
/// (packed_points.h): no memory beyond the pool, a packed block, and 40 bytes per tile; few files open at a time. When
/// the pool is empty, the fullest block is written out. Every system call is checked: IoError with the file, the
/// reason, and for a full disk the bytes still needed and free. Not thread-safe.
class SpoolWriter {
 public:
  struct Limits {
    std::size_t buffer_bytes = 16 * 1024 * 1024;  ///< Of the pool; at least one point is always held.
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
  std::uint64_t points() const { return points_; }
  std::uint64_t written_bytes() const { return written_bytes_; }

 private:
  struct Tile {
    std::uint32_t block = kNone;
    std::uint32_t used = 0;    // Points in the block.
    std::uint64_t points = 0;  // In the file.
    int descriptor = -1;
    bool created = false;
  };
  static constexpr std::uint32_t kNone = 0xffffffffU;

  void acquire_block(std::size_t tile);
  void flush(std::size_t tile);
  void write(std::size_t tile, std::span<const std::byte> bytes);
  int open_file(std::size_t tile);
  void close_file(std::size_t tile);
  [[noreturn]] void fail(std::size_t tile, const char* what, int reason) const;

  std::filesystem::path folder_;
  Limits limits_;
  std::uint32_t block_points_;
  std::vector<Tile> tiles_;
  std::unique_ptr<SpooledPoint[]> pool_;
  std::vector<std::byte> packed_;  // A block on its way to a file.
  std::vector<std::uint32_t> free_blocks_;
  std::vector<std::size_t> block_owner_;  // Per block; meaningless for free ones.
  std::vector<std::size_t> open_tiles_;   // Oldest first.
  std::uint64_t points_ = 0;
  std::uint64_t written_bytes_ = 0;
};

/// Reads a spool file back. Throws IoError if it cannot be read or is not what was written.
void read_spool(const std::filesystem::path& path, LatticePoints& positions, PointIds& ids);

}  // namespace arris::tiling
