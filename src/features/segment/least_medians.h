#pragma once
/// @file The least median of many rows of distances, in every lane of a vector.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "features/numerics/simd.h"
#include "features/numerics/sorting_network.h"

namespace arris::detail {

/// Least upper medians so far of rows of n <= N distances, N a power of two. Most rows are no better than what came
/// before, which counting shows (the caller does that). Of the others some wait, a column each, whatever lane they are
/// of, until there are as many as a vector has lanes; where several lanes are better at once all are settled at once.
template <class F, std::size_t N>
class LeastMedians {
 public:
  static constexpr std::size_t kLanes = sizeof(F) / sizeof(float);
  /// Distances as bits: not negative, they sort as their bits do.
  using Bits = typename simd::Wide<sizeof(F)>::Int;
  /// What is behind the n distances brings the median to the middle. (Behind: nothing may be read from where the same
  /// place of a page has just been written, and points are read in the order in which distances are written.)
  using Rows = std::array<Bits, N>;

  explicit LeastMedians(std::size_t n) : n_(n) { pad(waiting_rows_); }

  ARRIS_ALWAYS_INLINE void pad(Rows& rows) const {
    const std::size_t below = N / 2 - n_ / 2;
    for (std::size_t i = n_; i < N; ++i)
      rows[i] = Bits{} + (i < n_ + below ? 0 : std::numeric_limits<std::int32_t>::max());
  }

  /// May be above the least so far, of rows that wait.
  const F& least() const { return least_; }
  std::size_t trial(std::size_t lane) const { return static_cast<std::size_t>(trial_[lane]); }

  /// @param trial  ascending from call to call. @param better  lanes whose median is below least(): negative.
  ARRIS_ALWAYS_INLINE void add(std::int32_t trial, const Bits& better, const Rows& rows) {
    std::uint32_t lanes = bits_of(better);
    if (std::popcount(lanes) >= kSeveral) {
      settle_all(trial, better, rows);
      return;
    }
    for (; lanes != 0; lanes &= lanes - 1) wait(trial, static_cast<std::size_t>(std::countr_zero(lanes)), rows);
  }
  ARRIS_ALWAYS_INLINE void settle() {
    const F medians = medians_of(waiting_rows_);
    for (std::size_t column = 0; column < waiting_; ++column) {
      const auto [trial, lane] = of_[column];
      const float median = medians[column];
      // The first of equals stays.
      if (median > least_[lane] || (median == least_[lane] && trial >= trial_[lane])) continue;
      least_[lane] = median;
      trial_[lane] = trial;
    }
    waiting_ = 0;
  }

 private:
  /// From here on a network for all lanes costs less than to copy those that are better.
  static constexpr int kSeveral = 3;

  ARRIS_ALWAYS_INLINE static F medians_of(const Rows& rows) {
    Bits values[N];
    ARRIS_UNROLL
    for (std::size_t i = 0; i < N; ++i) values[i] = rows[i];
    RankNetwork<N, N / 2, N / 2>::run(values);
    return (F)values[N / 2];
  }
  ARRIS_ALWAYS_INLINE void settle_all(std::int32_t trial, const Bits& better, const Rows& rows) {
    const F medians = medians_of(rows);
    const F candidate = better < 0 ? medians : least_;
    trial_ = candidate < least_ ? Bits{} + trial : trial_;
    least_ = candidate < least_ ? candidate : least_;
  }
  ARRIS_ALWAYS_INLINE void wait(std::int32_t trial, std::size_t lane, const Rows& rows) {
    for (std::size_t i = 0; i < n_; ++i) waiting_rows_[i][waiting_] = rows[i][lane];
    of_[waiting_++] = {trial, static_cast<std::int32_t>(lane)};
    if (waiting_ == kLanes) settle();
  }
  /// One bit per lane, of those that are negative.
  ARRIS_ALWAYS_INLINE static std::uint32_t bits_of(const Bits& lanes) {
    Bits own;
    for (std::size_t lane = 0; lane < kLanes; ++lane) own[lane] = 1 << lane;
    std::uint64_t words[kLanes / 2];
    simd::store(words, (lanes >> 31) & own);
    std::uint64_t all = 0;
    for (const std::uint64_t word : words) all |= word;
    return static_cast<std::uint32_t>(all | (all >> 32));
  }

  struct Origin {
    std::int32_t trial, lane;
  };
  std::size_t n_;
  F least_ = F{} + 1e30F;
  Bits trial_{};
  std::size_t waiting_ = 0;
  std::array<Origin, kLanes> of_;
  Rows waiting_rows_;
};

}  // namespace arris::detail
