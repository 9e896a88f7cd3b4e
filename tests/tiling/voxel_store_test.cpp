#include "tiling/voxel_store.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/error.h"
#include "support/temp_folder.h"
#include "tiling/random_cloud.h"
#include "tiling/voxel_accumulator.h"
#include "tiling/voxel_file.h"
#include "tiling/voxel_oracle.h"

namespace arris::tiling {
namespace {

constexpr std::int32_t kSide = 5;

VoxelStore store_of(const std::vector<LatticePoint>& points, const std::filesystem::path& folder) {
  VoxelAccumulator accumulator(VoxelGrid(kSide), {folder, 1 << 20});
  accumulator.add(points);
  return accumulator.finish();
}

struct Loaded {
  std::vector<Voxel> voxels;
  std::vector<std::uint32_t> ranks;
  friend bool operator==(const Loaded&, const Loaded&) = default;
};

Loaded load(const VoxelStore& store, const LatticeBox& keys) {
  Loaded loaded;
  store.load(keys, loaded.voxels, loaded.ranks);
  return loaded;
}

Loaded chosen(const std::vector<Voxel>& all, const LatticeBox& keys) {
  Loaded loaded;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!keys.contains(all[i].key)) continue;
    loaded.voxels.push_back(all[i]);
    loaded.ranks.push_back(static_cast<std::uint32_t>(i));
  }
  return loaded;
}

RC_GTEST_PROP(VoxelStore, AnyBox_LoadsItsVoxelsAndTheirRanks, ()) {
  const auto points = test::any_cloud(1, 6000);
  const test::TempFolder folder;
  const VoxelStore store = store_of(points, folder.path());
  const auto all = test::voxels_of(kSide, points, {});
  for (int i = 0; i < 10; ++i) {
    LatticeBox box;
    box.include(all[*rc::gen::inRange<std::size_t>(0, all.size())].key);
    if (i % 3 != 0) box.include(all[*rc::gen::inRange<std::size_t>(0, all.size())].key);
    box = box.expanded(*rc::gen::inRange<std::int64_t>(-3, 40));
    RC_ASSERT(load(store, box) == chosen(all, box));
  }
  std::uint32_t hint = 7;
  for (std::size_t i = 0; i < all.size(); ++i) RC_ASSERT(store.index().rank(all[i].key, hint) == i);
}

TEST(VoxelStore, OldContentOfTheOutputs_IsReplaced) {
  const test::TempFolder folder;
  const VoxelStore store = store_of({{0, 0, 0}}, folder.path());
  Loaded loaded{std::vector<Voxel>(9), std::vector<std::uint32_t>(7)};
  store.load({{5, 5, 5}, {9, 9, 9}}, loaded.voxels, loaded.ranks);
  EXPECT_EQ(loaded, Loaded{});
  store.load({{0, 0, 0}, {0, 0, 0}}, loaded.voxels, loaded.ranks);
  EXPECT_EQ(loaded, Loaded{});
}

TEST(VoxelStore, Moved_StillOwnsItsFile) {
  const test::TempFolder folder;
  const auto file = folder / "voxels.store";
  {
    VoxelStore first = store_of(test::random_cloud(1, 100), folder.path());
    const VoxelStore second = std::move(first);
    EXPECT_TRUE(std::filesystem::exists(file));
    EXPECT_EQ(load(second, second.index().bounds()).ranks.size(), second.size());
  }
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(VoxelStore, FlippedBitOrMissingEnd_IsAnIoErrorThatNamesTheFile) {
  const auto points = test::plane_grid(100, kSide);  // Ten chunks.
  const auto all = test::voxels_of(kSide, points, {});
  const auto message_of = [](const VoxelStore& store, const LatticeBox& box) -> std::string {
    try {
      load(store, box);
    } catch (const IoError& error) {
      return error.what();
    }
    return {};
  };
  std::mt19937_64 random(1);
  for (int i = 0; i < 30; ++i) {
    const test::TempFolder folder;
    const VoxelStore store = store_of(points, folder.path());
    const std::size_t byte = random() % store.bytes_on_disk();
    test::flip_bit(folder / "voxels.store", byte, i % 8);
    EXPECT_NE(message_of(store, store.index().bounds()).find("voxels.store"), std::string::npos) << byte;
    LatticeBox box;
    box.include(all[byte / VoxelLayout(VoxelGrid(kSide), false).bytes()].key);
    EXPECT_NE(message_of(store, box).find("voxels.store"), std::string::npos) << byte;
    test::flip_bit(folder / "voxels.store", byte, i % 8);
    EXPECT_EQ(load(store, store.index().bounds()), chosen(all, store.index().bounds()));
    std::filesystem::resize_file(folder / "voxels.store", byte);
    EXPECT_NE(message_of(store, store.index().bounds()).find("voxels.store"), std::string::npos) << byte;
  }
}

TEST(VoxelStore, ManyThreads_ReadTheSame) {
  const auto points = test::random_cloud(8, 30'000);
  const auto all = test::voxels_of(kSide, points, {});
  const test::TempFolder folder;
  const VoxelStore store = store_of(points, folder.path());
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    threads.emplace_back([&, seed] {
      std::mt19937_64 random(seed);
      std::uint32_t hint = 0;
      for (int i = 0; i < 20; ++i) {
        LatticeBox box;
        box.include(all[random() % all.size()].key);
        box.include(all[random() % all.size()].key);
        if (!(load(store, box) == chosen(all, box))) ++wrong;
        const std::size_t at = random() % all.size();
        if (store.index().rank(all[at].key, hint) != at) ++wrong;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace arris::tiling
