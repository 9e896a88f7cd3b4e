#pragma once
/// @file Pass 2: routes every point to its owning tile and to every tile whose halo holds it.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/cancel.h"
#include "core/progress.h"
#include "io/point_source.h"
#include "tiling/survey.h"
#include "tiling/tile_plan.h"

namespace arris::tiling {

struct PartitionOptions {
  std::filesystem::path folder;                 ///< Spool files go here: one per tile, "<index>.spool".
  std::size_t buffer_bytes = 16 * 1024 * 1024;  ///< Bound of all spool buffers together (a fixed pool of blocks).
};

struct PartitionResult {
  std::uint64_t spooled_points = 0;  ///< Core and halo copies.
  std::uint64_t spooled_bytes = 0;
};

/// The work of partition_points on batches of lattice points. Memory: the spool buffers, a copy of the survey's counts,
/// and about 150 bytes per tile. Not thread-safe, but for count(), which may run ahead on a thread of its own.
///
/// Laws: (1) when closed(tile) is called, the tile's spool file holds exactly the points inside its covered box; (2)
/// every tile is closed exactly once: after the points with which the survey's counts prove that no later one can
/// belong to it, else in finish() (tiles that no survey cell touches); (3) finish() returns only if the points added
/// are, cell by cell, as many as the survey counted.
class Partitioner {
 public:
  Partitioner(const CellCounts& counts, const TilePlan& plan, const PartitionOptions& options,
              std::function<void(std::size_t tile)> closed);
  ~Partitioner();
  Partitioner(const Partitioner&) = delete;
  Partitioner& operator=(const Partitioner&) = delete;

  /// Adds points with ids first_id, first_id + 1, ...: count(), spool(), close(). Throws InputError, IoError.
  void add(std::span<const LatticePoint> points, std::uint64_t first_id);
  /// Appends the tiles to which no point after these can belong to `complete`. Points are counted in the order in which
  /// they are spooled. Throws InputError for points that the survey did not count.
  void count(std::span<const LatticePoint> points, std::uint64_t first_id, std::vector<std::uint32_t>& complete);
  /// Throws IoError.
  void spool(std::span<const LatticePoint> points, std::uint64_t first_id);
  /// All points counted with these tiles must be in their spools. Throws IoError.
  void close(std::span<const std::uint32_t> complete);
  /// Throws InputError if points are missing that the survey counted.
  PartitionResult finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Streams all inputs once through a Partitioner. `closed(tile)` is called (from this thread) as soon as no later point
/// can belong to the tile, which the survey's cell counts prove; its spool file is complete then. Every tile is closed
/// exactly once before this returns. Throws InputError if the inputs no longer hold what the survey counted (changed
/// while running), IoError, Cancelled.
PartitionResult partition_points(io::InputSet& inputs, const Survey& survey, const TilePlan& plan,
                                 const PartitionOptions& options, const std::function<void(std::size_t tile)>& closed,
                                 ProgressSink& progress, const CancelToken& cancel);

}  // namespace arris::tiling
