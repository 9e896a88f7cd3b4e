#include "merge/cluster_sums.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace arris::merge {
namespace {

TEST(ClusterSums, Units_AreTheNearestWholeNumbersHalvesAwayFromZero) {
  for (std::int32_t halves = -70000; halves <= 70000; ++halves) {
    const float value = 0.5F * static_cast<float>(halves);
    for (const float near : {value, std::nextafter(value, -1e9F), std::nextafter(value, 1e9F)})
      ASSERT_EQ(units(near, 1.0F), std::lround(near)) << near;
  }
}

RC_GTEST_PROP(ClusterSums, UnitsOfAnyComponent_RoundAsTheLibraryDoes, ()) {
  const float component = static_cast<float>(*rc::gen::inRange(-1000000, 1000001)) * 1e-6F;
  RC_ASSERT(units(component, kNormalUnits) == std::lround(component * kNormalUnits));
}

RC_GTEST_PROP(ClusterSlots, AnyClustersInAnyOrder_PutOutTheSumOfWhatWasAdded, ()) {
  const auto most = *rc::gen::element<std::uint32_t>(3, 100, 1000, 4000000000U);
  const auto clusters = *rc::gen::container<std::vector<std::uint32_t>>(rc::gen::inRange<std::uint32_t>(0, most));
  std::map<std::uint32_t, std::uint64_t> expected, sums;
  ClusterSlots<std::uint64_t> slots;
  const auto put_out = [&](std::uint32_t cluster, std::uint64_t sum) { sums[cluster] += sum; };
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    expected[clusters[i]] += i + 1;
    slots.at(clusters[i], put_out) += i + 1;
  }
  slots.put_all_out(put_out);
  slots.put_all_out([](std::uint32_t, std::uint64_t) { RC_FAIL("put out twice"); });
  RC_ASSERT(sums == expected);
}

}  // namespace
}  // namespace arris::merge
