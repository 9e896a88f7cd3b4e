#include "tiling/voxel_tiles.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "tiling/voxel_file.h"
#include "tiling/voxel_selection.h"

namespace arris::tiling {
namespace {

constexpr int kBlockLevel = 3;  // Of VoxelIndex.
/// A cell with more than 1/64 of the voxels of a tile makes halos too large, which hold whole cells.
constexpr std::uint64_t kCellsOfATile = 64;
/// Read at a time, by each thread.
constexpr std::uint32_t kPieceVoxels = 4 * VoxelFile::kChunkVoxels;
constexpr std::size_t kGrainPieces = 2;

/// Whole blocks, which hold the box.
LatticeBox in_blocks(LatticeBox box) {
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = box.min[axis] >> kBlockLevel << kBlockLevel;
    box.max[axis] = (box.max[axis] + VoxelIndex::kBlockSide - 1) >> kBlockLevel << kBlockLevel;
  }
  return box;
}

/// All voxels in one tile, if they fit: nothing has to be counted then.
std::optional<TilePlan> plan_one_tile(const VoxelBlocks& blocks, const VoxelPlanRequest& request) {
  LatticeBox occupied;
  std::uint64_t voxels = 0;
  blocks([&](const LatticePoint& block, std::uint64_t count) {
    occupied.include(block);
    voxels += count;
  });
  const std::uint64_t most_core = request.max_core_voxels == 0 ? voxels : request.max_core_voxels;
  if (voxels == 0 || voxels > request.max_voxels || voxels > most_core) return std::nullopt;
  PlannedTile tile;
  for (int axis = 0; axis < 3; ++axis) {
    tile.core.min[axis] = occupied.min[axis] * VoxelIndex::kBlockSide;
    tile.core.max[axis] = occupied.max[axis] * VoxelIndex::kBlockSide;
  }
  tile.covered = in_blocks(tile.core.expanded(std::max(1, request.halo_voxels)));
  tile.core_points = tile.covered_points = voxels;
  return TilePlan{{tile}, voxels, 1.0};
}

/// Voxels that are read together, and their place in the tile.
struct Piece {
  std::uint32_t begin_rank;
  std::uint32_t end_rank;
  std::size_t at;
};

/// Cut where chunks of the file end, so that none is read twice.
std::vector<Piece> pieces_of(const VoxelIndex& index, std::span<const BlockRange> blocks) {
  std::vector<Piece> pieces;
  std::size_t at = 0;
  for (const BlockRange& range : blocks) {
    const std::uint32_t end = index.first_rank(range.end);
    for (std::uint32_t rank = index.first_rank(range.begin); rank < end;) {
      const std::uint32_t next = rank + std::min(kPieceVoxels - rank % kPieceVoxels, end - rank);
      pieces.push_back({rank, next, at});
      at += next - rank;
      rank = next;
    }
  }
  return pieces;
}

VoxelPosition position_of(const VoxelGrid& grid, const Voxel& voxel) {
  VoxelPosition at;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t corner = kVoxelFractions * grid.corner(voxel.key[axis]);
    at[static_cast<std::size_t>(axis)] =
        static_cast<std::uint32_t>(static_cast<std::uint64_t>(corner)) + voxel.centroid[static_cast<std::size_t>(axis)];
  }
  return at;
}

/// Reads in parallel: with whole blocks the place of every voxel is known before.
VoxelTile load(const VoxelStore& store, const PlannedTile& planned, std::span<const BlockRange> blocks, bool colours) {
  VoxelTile tile(store.grid());
  const std::vector<Piece> pieces = pieces_of(store.index(), blocks);
  const std::size_t size = pieces.empty() ? 0 : pieces.back().at + (pieces.back().end_rank - pieces.back().begin_rank);
  tile.keys.resize(size);
  tile.positions.resize(size);
  tile.ranks.resize(size);
  tile.core.resize(size);
  if (colours) tile.colours.resize(size);
  parallel_for_chunks(pieces.size(), kGrainPieces, [&](std::size_t begin, std::size_t end) {
    std::vector<Voxel> voxels;
    for (const Piece& piece : std::span(pieces).subspan(begin, end - begin)) {
      store.read(piece.begin_rank, piece.end_rank, voxels);
      for (std::size_t i = 0; i < voxels.size(); ++i) {
        const Voxel& voxel = voxels[i];
        const std::size_t v = piece.at + i;
        tile.keys[v] = voxel.key;
        tile.positions[v] = position_of(tile.grid, voxel);
        tile.ranks[v] = piece.begin_rank + static_cast<std::uint32_t>(i);
        tile.core[v] = planned.core.contains(voxel.key) ? 1 : 0;
        if (colours) tile.colours[v] = voxel.colour;
      }
    }
  });
  return tile;
}

}  // namespace

TilePlan plan_voxel_tiles(const VoxelIndex& index, const VoxelPlanRequest& request) {
  return plan_voxel_tiles(
      [&](const VisitBlock& visit) {
        for (std::size_t i = 0; i < index.blocks(); ++i) visit(index.block(i).key, index.block(i).voxels);
      },
      request);
}

TilePlan plan_voxel_tiles(const VoxelBlocks& blocks, const VoxelPlanRequest& request) {
  if (std::optional<TilePlan> one = plan_one_tile(blocks, request)) return *std::move(one);
  Survey voxels;  // Voxels take the place of points, one to a step.
  voxels.lattice = {1.0, {0.0, 0.0, 0.0}};
  voxels.spacing = 1.0;
  voxels.counts = CellCounts(kBlockLevel);
  const auto add_blocks = [&](const PlanCells::Add& add) {
    blocks([&](const LatticePoint& block, std::uint64_t count) {
      const LatticePoint corner{block.x * (1 << kBlockLevel), block.y * (1 << kBlockLevel),
                                block.z * (1 << kBlockLevel)};
      add({&corner, 1}, count);
    });
  };
  add_blocks(
      [&](std::span<const LatticePoint> corners, std::uint64_t count) { voxels.counts.add(corners.front(), count); });
  voxels.points_in = voxels.counts.total();
  voxels.counts.for_each_by_leaf([&](const LatticeBox& cell, std::uint64_t) { voxels.bounds.include(cell); });
  PlanRequest plan;
  plan.max_points = request.max_voxels;
  plan.max_core_points = request.max_core_voxels;
  plan.max_radius = std::max(1, request.halo_voxels);
  plan.whole_halo = true;
  plan.halo = [&](double) { return static_cast<double>(request.halo_voxels); };
  PlanCells cells(voxels, plan.max_points / kCellsOfATile, kBlockLevel);
  TilePlan tiles = plan_tiles(cells, plan);
  while (tiles.largest_covered_points > plan.max_points && cells.refine(add_blocks)) tiles = plan_tiles(cells, plan);
  for (PlannedTile& tile : tiles.tiles) tile.covered = in_blocks(tile.covered);
  return tiles;
}

VoxelTile load_voxels(const VoxelStore& store, const PlannedTile& planned, bool colours) {
  return load(store, planned, select_blocks(store.index(), planned.covered), colours);
}

VoxelTile load_voxel_tile(const VoxelStore& store, const PlannedTile& planned, bool colours, LinkBegins& begins) {
  const std::vector<BlockRange> blocks = select_blocks(store.index(), planned.covered);
  VoxelTile tile = load(store, planned, blocks, colours);
  if (tile.size() == store.size()) {
    link_neighbours(tile, store.index(), begins);
  } else {
    link_neighbours(tile, store.index().selection(blocks), begins);
  }
  return tile;
}

}  // namespace arris::tiling
