#include "tiling/voxel_merge.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "support/temp_folder.h"
#include "tiling/morton.h"
#include "tiling/random_cloud.h"

namespace arris::tiling {
namespace {

bool before(const VoxelRecord& a, const VoxelRecord& b) {
  return z_order_less(a.sums.key, b.sums.key);
}

using Content = std::tuple<LatticePoint, std::uint32_t, std::array<std::uint32_t, 3>, ColourSums>;
Content content(const VoxelRecord& r) {
  return {r.sums.key, r.sums.points, r.sums.offset, r.colour};
}

RC_GTEST_PROP(VoxelMerge, AnyRuns_GiveAllRecordsInZOrder, ()) {
  const auto keys = test::any_cloud(0, 2000);
  const auto count = *rc::gen::inRange<std::size_t>(1, 20).as("runs");
  const auto buffer_bytes = *rc::gen::element<std::size_t>(40, 100, 1000, 100'000).as("buffer bytes");
  std::mt19937_64 random(keys.size());
  const test::TempFolder folder;
  std::vector<std::unique_ptr<VoxelRun>> runs;
  std::vector<Content> expected;
  for (std::size_t run = 0; run < count; ++run) {
    const bool colours = random() % 2;
    std::vector<VoxelRecord> records;
    for (const LatticePoint& key : keys) {
      if (random() % count > 1) continue;
      const auto any = [&] { return static_cast<std::uint32_t>(random()); };
      records.push_back({{key, any(), {any(), any(), any()}}, {}});
      if (colours) records.back().colour = {any(), any(), any()};
    }
    std::ranges::stable_sort(records, before);
    const std::string name = "run" + std::to_string(run);
    runs.push_back(std::make_unique<VoxelRun>(folder / name.c_str(), colours, 500));
    for (const VoxelRecord& record : records) {
      runs.back()->append(record);
      expected.push_back(content(record));
    }
    runs.back()->close();
  }
  const auto least = *rc::gen::element<std::size_t>(0, 1, 2, 7, 1000).as("records at a time, 0: one by one");
  VoxelMerge merge(runs, buffer_bytes);
  std::vector<VoxelRecord> merged, some;
  if (least == 0) {
    for (VoxelRecord record; merge.next(record);) merged.push_back(record);
  }
  while (least > 0 && merge.next(some, least)) {
    const bool is_cut = !merged.empty() && merged.back().sums.key == some.front().sums.key;
    RC_ASSERT(!is_cut);
    merged.insert(merged.end(), some.begin(), some.end());
    const bool is_full = some.size() >= least || merged.size() == expected.size();
    RC_ASSERT(is_full);
  }
  RC_ASSERT(std::ranges::is_sorted(merged, before));
  std::vector<Content> found;
  for (const VoxelRecord& record : merged) found.push_back(content(record));
  std::ranges::sort(found);
  std::ranges::sort(expected);
  RC_ASSERT(found == expected);
}

}  // namespace
}  // namespace arris::tiling
