#include "tiling/normal_file.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <utility>
#include <vector>

#include "core/error.h"
#include "support/temp_folder.h"

namespace arris::tiling {
namespace {

NormalFile::Normal normal_of(std::uint32_t rank) {
  return {static_cast<float>(rank), 0.5F, -static_cast<float>(rank)};
}

/// Voxels of these ranks; those that `is_core` says are of the core.
template <class IsCore>
VoxelTile tile_of(std::uint32_t begin, std::uint32_t end, IsCore&& is_core) {
  VoxelTile tile{VoxelGrid(1)};
  for (std::uint32_t rank = begin; rank < end; ++rank) {
    tile.keys.push_back({0, 0, 0});
    tile.ranks.push_back(rank);
    tile.core.push_back(is_core(rank) ? 1 : 0);
  }
  return tile;
}

std::vector<NormalFile::Normal> normals_of(const VoxelTile& tile) {
  std::vector<NormalFile::Normal> normals;
  for (std::size_t v = 0; v < tile.size(); ++v)
    normals.push_back(tile.core[v] != 0 ? normal_of(tile.ranks[v]) : NormalFile::Normal{});
  return normals;
}

constexpr std::uint32_t kVoxels = 60'000;

TEST(NormalFile, CoresOfTiles_AreReadByRank) {
  const test::TempFolder folder;
  NormalFile file(folder.path() / "normals");
  for (const std::uint32_t offset : {1U, 0U}) {
    const VoxelTile tile = tile_of(0, kVoxels, [&](std::uint32_t rank) { return rank / 7 % 2 == offset; });
    file.append(tile, normals_of(tile));
  }
  file.finish();
  EXPECT_EQ(file.size_bytes(), 12U * kVoxels);
  for (const auto& [begin, end] : {std::pair(0U, kVoxels), std::pair(100U, 101U), std::pair(29'990U, 45'678U)}) {
    const VoxelTile tile = tile_of(begin, end, [](std::uint32_t) { return true; });
    const auto read = file.read(tile);
    ASSERT_EQ(read.size(), tile.size());
    for (std::size_t v = 0; v < read.size(); ++v) ASSERT_EQ(read[v], normal_of(tile.ranks[v])) << tile.ranks[v];
  }
}

TEST(NormalFile, LongAndShortStretches_AreReadByRank) {
  const test::TempFolder folder;
  NormalFile file(folder.path() / "normals");
  const auto first = [](std::uint32_t rank) { return rank < 30'000 ? rank % 30 < 11 : rank < 52'000; };
  for (const bool turn : {true, false}) {
    const VoxelTile tile = tile_of(0, kVoxels, [&](std::uint32_t rank) { return first(rank) == turn; });
    file.append(tile, normals_of(tile));
  }
  file.finish();
  const VoxelTile tile = tile_of(0, kVoxels, [](std::uint32_t) { return true; });
  const auto read = file.read(tile);
  for (std::size_t v = 0; v < read.size(); ++v) ASSERT_EQ(read[v], normal_of(tile.ranks[v])) << tile.ranks[v];
}

TEST(NormalFile, DamagedBytes_AreNoticed) {
  const test::TempFolder folder;
  const std::filesystem::path path = folder.path() / "normals";
  NormalFile file(path);
  const VoxelTile tile = tile_of(0, kVoxels, [](std::uint32_t) { return true; });
  file.append(tile, normals_of(tile));
  file.finish();
  std::fstream(path, std::ios::in | std::ios::out | std::ios::binary).seekp(12 * 50'000).put('x');
  EXPECT_THROW(file.read(tile), IoError);
  EXPECT_NO_THROW(file.read(tile_of(0, 10'000, [](std::uint32_t) { return true; })));
}

}  // namespace
}  // namespace arris::tiling
