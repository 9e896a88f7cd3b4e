#include "pipeline/voxel_tile_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/pages.h"
#include "core/process_memory.h"
#include "core/text.h"
#include "features/supervoxel/voxel_normals.h"
#include "pipeline/voxel_memory.h"
#include "tiling/voxel_tiles.h"

namespace arris::pipeline {
namespace {

/// Full intensity of the colours of voxels.
constexpr double kFullColour = 65535.0;
/// A tile is not cut below this many voxels for want of memory.
constexpr std::uint64_t kLeastTileVoxels = 20'000;

/// Of the block of a voxel, on average.
double block_voxels(const tiling::VoxelIndex& index) {
  double sum = 0.0;
  for (std::size_t i = 0; i < index.blocks(); ++i) {
    const double voxels = index.block(i).voxels;
    sum += voxels * voxels;
  }
  return index.size() == 0 ? 0.0 : sum / index.size();
}

}  // namespace

double likely_neighbours(double block_voxels) {
  constexpr double kBlockVoxels = 512.0;
  return 8.0 + 18.0 * std::min(1.0, 2.0 * block_voxels / kBlockVoxels);
}

double lone_voxels(double voxels, double blocks) {
  return std::clamp(2.0 * blocks - voxels, 0.0, voxels);
}

std::uint64_t most_tile_voxels(double room_bytes, double bytes_per_voxel) {
  return std::max(kLeastTileVoxels, static_cast<std::uint64_t>(std::max(room_bytes, 0.0) / bytes_per_voxel));
}

void VoxelTileWalk::plan(std::uint64_t kept_bytes) {
  const double each = supervoxel_bytes_per_voxel(request_.parameters.features, request_.colours,
                                                 likely_neighbours(block_voxels(store_.index())));
  const std::uint64_t room = request_.memory_bytes > kept_bytes ? request_.memory_bytes - kept_bytes : 0;
  tiling::VoxelPlanRequest tiles;
  tiles.max_voxels = most_tile_voxels(static_cast<double>(room), each);
  tiles.max_core_voxels = request_.tile_voxels_cap;
  tiles.halo_voxels = request_.scale.halo_voxels();
  plan_ = tiling::plan_voxel_tiles(store_.index(), tiles);
  link_begins_.assign(plan_.tiles.size(), {});
  loaded_.reset();
  trim_heap();
  const auto tile_bytes = static_cast<std::uint64_t>(each * static_cast<double>(largest_tile_voxels()));
  // What larger tiles have left must not be resident beside what is kept now.
  if (spare_pages_bytes() > tile_bytes) drop_spare_pages();
  const auto voxels = static_cast<double>(std::max<std::uint64_t>(1, store_.size()));
  const double lone = lone_voxels(voxels, static_cast<double>(store_.index().blocks())) / voxels;
  predicted_bytes_ = kept_bytes + tile_bytes +
                     static_cast<std::uint64_t>(kLoneBytes * lone * static_cast<double>(largest_tile_voxels()));
  require(predicted_bytes_);
}

void VoxelTileWalk::require(std::uint64_t bytes) const {
  if (bytes <= request_.memory_bytes) return;
  throw BudgetError(fmt::format(
      "{} voxels and their supervoxels do not fit; run with at least --memory {}, or with larger --voxel or --seed",
      grouped(store_.size()), budget_text(raised_budget_bytes(request_.budget_bytes, bytes - request_.memory_bytes))));
}

std::uint64_t VoxelTileWalk::largest_tile_voxels() const {
  return std::min<std::uint64_t>(plan_.largest_covered_points, store_.size());
}

LoadedTile VoxelTileWalk::load(std::size_t number, TileView view) {
  const tiling::PlannedTile& tile = plan_.tiles[number];
  if (view == TileView::kFeatures || plan_.tiles.size() == 1)
    return {tiling::load_voxel_tile(store_, tile, request_.colours, link_begins_[number]), {}};
  tiling::PlannedTile core = tile;
  core.covered = tile.core;
  return {tiling::load_voxels(store_, core, false), {}};
}

void VoxelTileWalk::describe(LoadedTile& tile) {
  PageVector<std::array<float, 3>> normals = normals_known_ ? normals_->read(tile.voxels) : voxel_normals(tile.voxels);
  if (normals_ && !normals_known_) normals_->append(tile.voxels, normals);
  tile.features = voxel_features(tile.voxels, std::move(normals), request_.parameters, kFullColour);
}

void VoxelTileWalk::for_each(TileView view, const std::function<void(const LoadedTile&)>& use) {
  const bool several = plan_.tiles.size() > 1;
  const bool first_normals = several && view == TileView::kFeatures && !normals_known_;
  if (first_normals) normals_.emplace(request_.folder / fmt::format("normals-{}", request_.scale.voxel_steps));
  for (std::size_t tile = 0; tile < plan_.tiles.size(); ++tile) {
    cancel_.check();
    if (several || !loaded_) {
      drop();
      loaded_.emplace(load(tile, view));
    }
    if (view == TileView::kFeatures && loaded_->features.normals.empty()) describe(*loaded_);
    use(*loaded_);
    progress_.advance(plan_.tiles[tile].core_points);
  }
  if (several) {
    drop();
    trim_heap();  // Tiles of all sizes leave holes.
  }
  if (!first_normals) return;
  normals_->finish();
  normals_known_ = true;
}

void VoxelTileWalk::drop() {
  loaded_.reset();
}

}  // namespace arris::pipeline
