#pragma once
/// @file Compare-exchanges that the compiler knows, for vectors whose lanes are sorted side by side in registers.

#include <array>
#include <cstddef>
#include <utility>

#include "features/numerics/merge_exchange.h"
#include "features/numerics/simd.h"

namespace arris {

/// After the exchanges, each of which puts the smaller of two values to `low`, the values of ranks [First, Last] are
/// where sorting N values (a power of two) would put them: Batcher's merge exchange (Knuth, The Art of Computer
/// Programming 3, algorithm 5.2.2 M) without what those places do not depend on.
template <std::size_t N, std::size_t First, std::size_t Last>
struct RankNetwork {
  struct Exchange {
    std::size_t low = 0, high = 0;
  };
  struct Exchanges {
    std::array<Exchange, N * N / 2> list{};
    std::size_t count = 0;
  };

  static constexpr Exchanges all() {
    Exchanges all;
    for_each_merge_exchange(N, [&all](std::size_t low, std::size_t high) { all.list[all.count++] = {low, high}; });
    return all;
  }

  /// In reverse order.
  static constexpr Exchanges needed_backwards() {
    const Exchanges every = all();
    std::array<bool, N> matters{};
    for (std::size_t i = First; i <= Last; ++i) matters[i] = true;
    Exchanges needed;
    for (std::size_t i = every.count; i-- > 0;) {
      const auto [low, high] = every.list[i];
      if (!matters[low] && !matters[high]) continue;
      matters[low] = matters[high] = true;
      needed.list[needed.count++] = every.list[i];
    }
    return needed;
  }

  static constexpr Exchanges kBackwards = needed_backwards();

  /// Of all lanes; V has integers, for which compilers know minimum and maximum.
  template <class V>
  static ARRIS_ALWAYS_INLINE void run(V (&values)[N]) {
    run(values, std::make_index_sequence<kBackwards.count>());
  }

 private:
  template <class V, std::size_t... I>
  static ARRIS_ALWAYS_INLINE void run(V (&values)[N], std::index_sequence<I...>) {
    (exchange(values[kBackwards.list[sizeof...(I) - 1 - I].low], values[kBackwards.list[sizeof...(I) - 1 - I].high]),
     ...);
  }

  template <class V>
  static ARRIS_ALWAYS_INLINE void exchange(V& low, V& high) {
    const V smaller = low < high ? low : high;
    high = low < high ? high : low;
    low = smaller;
  }
};

}  // namespace arris
