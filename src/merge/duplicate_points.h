#pragma once
/// @file Points at a position that another point of the scan has too, on disk.

#include <cstdint>
#include <functional>
#include <mutex>

#include "core/lattice.h"
#include "core/tile_points.h"
#include "tiling/scratch_file.h"

namespace arris::merge {

struct DuplicatePoint {
  std::uint32_t id = 0;
  std::uint32_t of = 0;  ///< The smallest id at this position.
  LatticePoint position;
};

/// 20 bytes on disk per point that is not the first at its position.
class DuplicatePoints {
 public:
  explicit DuplicatePoints(std::filesystem::path file);

  /// The duplicates in a tile's core, once per tile. Thread-safe.
  void append(const TilePoints& tile);
  /// In the order of appending.
  void for_each(const std::function<void(const DuplicatePoint&)>& use) const;
  std::uint64_t bytes_on_disk() const { return file_.size_bytes(); }

 private:
  std::mutex mutex_;
  tiling::ScratchFile file_;
};

}  // namespace arris::merge
