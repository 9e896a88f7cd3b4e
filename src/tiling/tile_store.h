#pragma once
/// @file One checked .vdb file per tile (OpenVDB PointDataGrid), written once, verified whenever it is read.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/lattice.h"
#include "core/tile_points.h"
#include "tiling/point_grid.h"
#include "tiling/tile_plan.h"

namespace arris::tiling {

/// Tile files "<index>.vdb" in a folder and their manifest "manifest.jsonl" (per tile: points, bytes, XXH3-64 of the
/// file, core and covered box; for all: lattice, parameters' hash; manifest.h reads it). The world space of a tile file
/// is lattice steps. Methods may be called from several threads for different tiles.
class TileStore {
 public:
  /// The folder must exist. Starts a new manifest. Throws IoError.
  TileStore(std::filesystem::path folder, const Lattice& lattice, const TilePlan& plan, std::string parameters_hash);
  ~TileStore();

  /// Turns "<index>.spool" into "<index>.vdb" through a checked stream under a temporary name (flush, fsync, size
  /// compared, XXH3 recorded, rename), then removes the spool. Throws IoError; the spool stays then and no
  /// "<index>.vdb" appears. Returns what load() would, without reading it back.
  TilePoints build(std::size_t tile);
  /// Reads a tile back. Throws IoError if its bytes are not those that were written. Exact duplicates are folded;
  /// positions are in Z-order.
  TilePoints load(std::size_t tile) const;
  /// Points owned by `tile` (inside its core, duplicates included) for which keep(position) holds, in Z-order.
  /// @param near  leaves for whose box this is false are left out.
  SortedPoints load_core(std::size_t tile, const std::function<bool(const LatticePoint&)>& keep,
                         const std::function<bool(const LatticeBox&)>& near = {}) const;
  std::uint64_t points(std::size_t tile) const;  ///< Stored points (core and halo) of a built tile; 0 otherwise.
  std::uint64_t bytes_on_disk() const;           ///< Of all built tiles that were not removed.
  /// Deletes the tile's file, if it was built.
  void remove(std::size_t tile);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Predicted peak bytes of build() and of load() (including what load() returns), for a tile of `points` points,
/// wherever they are.
std::uint64_t build_bytes(std::uint64_t points);
std::uint64_t load_bytes(std::uint64_t points);

/// Sorts (position, id) pairs, folds exact duplicates: fills positions (in Z-order), ids and duplicates of `tile`.
void fold_duplicates(LatticePoints&& positions, PointIds&& ids, TilePoints& tile);

}  // namespace arris::tiling
