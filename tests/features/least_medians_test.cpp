// The least median of many rows against sorting each of them.

#include "features/segment/least_medians.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace arris {
namespace {

constexpr std::size_t kLanes = 16;

/// [trial][place][lane].
using Trials = std::vector<std::vector<std::array<float, kLanes>>>;

struct Found {
  std::array<float, kLanes> least{};
  std::array<std::size_t, kLanes> trial{};
};

template <std::size_t N>
struct FindLeast {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const Trials& trials, Found& found) {
    using F = typename simd::Wide<Bytes>::Float;
    using Medians = detail::LeastMedians<F, N>;
    using Bits = typename Medians::Bits;
    const std::size_t n = trials[0].size();
    for (std::size_t lane = 0; lane < kLanes; lane += Medians::kLanes) {
      Medians medians(n);
      typename Medians::Rows rows;
      medians.pad(rows);
      for (std::size_t trial = 0; trial < trials.size(); ++trial) {
        Bits below{};
        for (std::size_t i = 0; i < n; ++i) {
          const F value = simd::load<F>(trials[trial][i].data() + lane);
          rows[i] = (Bits)value;
          below = value < medians.least() ? below + 1 : below;
        }
        medians.add(static_cast<std::int32_t>(trial), static_cast<std::int32_t>(n / 2) - below, rows);
      }
      medians.settle();
      simd::store(found.least.data() + lane, medians.least());
      for (std::size_t k = 0; k < Medians::kLanes; ++k) found.trial[lane + k] = medians.trial(k);
    }
  }
};

void find_least(const Trials& trials, Found& found) {
  const std::size_t n = trials[0].size();
  if (n <= 8) return simd::dispatch<FindLeast<8>>(trials, found);
  if (n <= 16) return simd::dispatch<FindLeast<16>>(trials, found);
  if (n <= 32) return simd::dispatch<FindLeast<32>>(trials, found);
  simd::dispatch<FindLeast<64>>(trials, found);
}

float upper_median(const Trials& trials, std::size_t trial, std::size_t lane) {
  std::vector<float> values;
  for (const auto& row : trials[trial]) values.push_back(row[lane]);
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// Few different values: many medians are equal, and the first of them must be told.
RC_GTEST_PROP(LeastMedians, AnyRows_AreThoseOfSorting, ()) {
  const auto n = static_cast<std::size_t>(*rc::gen::inRange(1, 65));
  const auto count = static_cast<std::size_t>(*rc::gen::inRange(1, 60));
  const auto different = *rc::gen::element(3U, 40U, 1000000U);
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  Trials trials(count, std::vector<std::array<float, kLanes>>(n));
  for (auto& rows : trials)
    for (auto& row : rows)
      for (float& value : row) value = static_cast<float>(random() % different);
  Found found;
  find_least(trials, found);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    std::size_t best = 0;
    for (std::size_t trial = 1; trial < count; ++trial)
      if (upper_median(trials, trial, lane) < upper_median(trials, best, lane)) best = trial;
    RC_ASSERT(found.trial[lane] == best);
    RC_ASSERT(found.least[lane] == upper_median(trials, best, lane));
  }
}

}  // namespace
}  // namespace arris
