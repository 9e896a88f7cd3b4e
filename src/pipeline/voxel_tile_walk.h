#pragma once
/// @file Goes over the voxels of a scan tile by tile, as often as it takes.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "core/cancel.h"
#include "core/progress.h"
#include "features/supervoxel/supervoxel_parameters.h"
#include "features/supervoxel/voxel_features.h"
#include "tiling/normal_file.h"
#include "tiling/tile_plan.h"
#include "tiling/voxel_neighbours.h"
#include "tiling/voxel_store.h"

namespace arris::pipeline {

/// What a walk over tiles looks at.
enum class TileView {
  kCore,      ///< Voxels of the core, without neighbours.
  kFeatures,  ///< All that is covered, with neighbours and features.
};

struct LoadedTile {
  VoxelTile voxels;        ///< May be more than was asked for.
  VoxelFeatures features;  ///< Empty unless asked for.
};

struct TileWalkRequest {
  SupervoxelParameters parameters;
  SupervoxelScale scale;
  bool colours = false;
  std::uint64_t memory_bytes = 0;     ///< For tiles and what the caller keeps beside them.
  std::uint64_t tile_voxels_cap = 0;  ///< 0: none.
  std::uint64_t budget_bytes = 0;     ///< --memory, of which memory_bytes are left; for messages.
  std::filesystem::path folder;       ///< For normals, if there are several tiles, and for coarser voxels.
};

/// Neighbours of a voxel, from how many voxels share a block of the index: about 8 to 14 on surfaces, 26 in solids.
/// Rather too many. @param block_voxels  mean over voxels.
double likely_neighbours(double block_voxels);
/// What voxels next to nothing take besides, as seeds and leftovers. Measured.
constexpr double kLoneBytes = 48.0;
/// Those with a block of the index to themselves: next to nothing, or nearly all where voxels are finer than the scan.
double lone_voxels(double voxels, double blocks);
/// So many voxels of a tile fit, or the least that a tile is cut to.
std::uint64_t most_tile_voxels(double room_bytes, double bytes_per_voxel);

/// One tile at a time is in memory; a lone one stays there between walks. Of several, normals are computed once and
/// kept on disk. Not thread-safe.
class VoxelTileWalk {
 public:
  VoxelTileWalk(const tiling::VoxelStore& store, const TileWalkRequest& request, ProgressSink& progress,
                const CancelToken& cancel)
      : store_(store), request_(request), progress_(progress), cancel_(cancel) {}

  const tiling::VoxelStore& store() const { return store_; }
  const TileWalkRequest& request() const { return request_; }

  /// Cuts tiles (again). @param kept_bytes  what the caller keeps. Throws BudgetError if that and a tile do not fit.
  void plan(std::uint64_t kept_bytes);
  const tiling::TilePlan& tiles() const { return plan_; }
  std::uint64_t predicted_bytes() const { return predicted_bytes_; }
  std::uint64_t largest_tile_voxels() const;
  std::uint64_t normals_bytes_on_disk() const { return normals_ ? normals_->size_bytes() : 0; }

  /// Calls use(tile) for every tile.
  void for_each(TileView view, const std::function<void(const LoadedTile&)>& use);
  void drop();  ///< Frees the tile that is kept, if any.

 private:
  /// Throws BudgetError if so much does not fit.
  void require(std::uint64_t bytes) const;
  LoadedTile load(std::size_t tile, TileView view);
  void describe(LoadedTile& tile);

  const tiling::VoxelStore& store_;
  TileWalkRequest request_;
  ProgressSink& progress_;
  const CancelToken& cancel_;
  tiling::TilePlan plan_;
  std::vector<tiling::LinkBegins> link_begins_;  ///< Per tile; empty until it is linked.
  std::optional<LoadedTile> loaded_;
  std::optional<tiling::NormalFile> normals_;  ///< While it is written, or complete.
  bool normals_known_ = false;
  std::uint64_t predicted_bytes_ = 0;
};

}  // namespace arris::pipeline
