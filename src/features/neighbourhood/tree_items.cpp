#include "features/neighbourhood/tree_items.h"

#include <algorithm>

#include "features/numerics/simd_compact.h"

namespace arris {
namespace {

/// Puts the items in front whose coordinate `before` holds for, without branches; returns how many.
template <class Before>
std::size_t part(std::span<TreeItem> items, int axis, Before before) {
  std::size_t n = 0;
  std::size_t gap = 0;  // Its item is kept aside.
  const TreeItem first = items[0];
  const std::size_t first_before = before(first.at[axis]);
  for (std::size_t i = 1; i < items.size(); ++i) {
    items[gap] = items[n];
    items[n] = items[i];
    gap = i;
    n += before(items[i].at[axis]);
  }
  items[gap] = items[n];
  items[n] = first;
  return n + first_before;
}

#if ARRIS_X86_KERNELS
static_assert(sizeof(TreeItem) == 16);
/// Items of a vector.
constexpr std::size_t kAtOnce = 4;

/// For each of the 16 masks of four items, the lanes of those that are set, then of those that are not.
struct PartTable {
  alignas(64) std::int32_t lanes[16][16];
  constexpr PartTable() : lanes{} {
    for (int mask = 0; mask < 16; ++mask) {
      int n = 0;
      for (const int wanted : {1, 0}) {
        for (int item = 0; item < 4; ++item) {
          if ((mask >> item & 1) != wanted) continue;
          for (int word = 0; word < 4; ++word) lanes[mask][n++] = 4 * item + word;
        }
      }
    }
  }
};
constexpr PartTable kPartTable;

/// Items that are read at once.
constexpr std::size_t kRead = 16;

/// Where parted items go: what is below the pivot to the front, the others to the back. Free is what is between, but
/// for what is still to be read.
struct Ends {
  TreeItem* front;
  TreeItem* back;

  /// Writes four at both ends, whole.
  ARRIS_TARGET_V4 ARRIS_ALWAYS_INLINE void place(const __m512i& four, const __m512i& pivots, __mmask16 keys) {
    const unsigned mask = _pext_u32(_mm512_mask_cmplt_epi32_mask(keys, four, pivots), keys);
    const __m512i parted = _mm512_permutexvar_epi32(_mm512_load_si512(kPartTable.lanes[mask]), four);
    const int below = __builtin_popcount(mask);
    _mm512_storeu_si512(front, parted);
    _mm512_storeu_si512(back - kAtOnce, parted);
    front += below;
    back -= static_cast<int>(kAtOnce) - below;
  }
};

/// part() by `< pivot`, four items at once. As many as are read at once are kept aside of either end first, and what is
/// read then comes from the end that has less room, so that four always fit in at both.
/// @param items  at least 2 kRead.
ARRIS_TARGET_V4 std::size_t part_below_avx512(std::span<TreeItem> items, int axis, std::int32_t pivot) {
  TreeItem* const begin = items.data();
  Ends free{begin, begin + items.size()};
  const TreeItem* unread = begin + kRead;
  const TreeItem* unread_end = free.back - kRead;
  TreeItem aside[3 * kRead];
  std::copy_n(begin, kRead, aside);
  std::copy_n(unread_end, kRead, aside + kRead);
  const __m512i pivots = _mm512_set1_epi32(pivot);
  const auto keys = static_cast<__mmask16>(0x1111U << axis);
  while (unread_end - unread >= static_cast<std::ptrdiff_t>(kRead)) {
    const TreeItem* from = unread;
    if (unread - free.front <= free.back - unread_end) {
      unread += kRead;
    } else {
      from = unread_end -= kRead;
    }
    __m512i read[kRead / kAtOnce];
    for (std::size_t i = 0; i < kRead / kAtOnce; ++i) read[i] = _mm512_loadu_si512(from + i * kAtOnce);
    for (const __m512i& four : read) free.place(four, pivots, keys);
  }
  const TreeItem* const kept_end = std::copy(unread, unread_end, aside + 2 * kRead);
  const TreeItem* kept = aside;
  // What is left over of fours first: the last four fill the free places, and those before them leave four or more.
  for (; (kept_end - kept) % static_cast<std::ptrdiff_t>(kAtOnce) != 0; ++kept) {
    *free.front = *kept;
    free.back[-1] = *kept;
    const bool below = kept->at[axis] < pivot;
    free.front += below;
    free.back -= !below;
  }
  for (; kept != kept_end; kept += kAtOnce) free.place(_mm512_loadu_si512(kept), pivots, keys);
  return static_cast<std::size_t>(free.front - begin);
}

ARRIS_TARGET_V4 ClosedBox box_of_avx512(std::span<const TreeItem> items) {
  __m512i low = _mm512_loadu_si512(items.data());
  __m512i high = low;
  for (std::size_t i = 0; i < items.size(); i += kAtOnce) {  // The last vector overlaps the one before.
    const __m512i at = _mm512_loadu_si512(items.data() + std::min(i, items.size() - kAtOnce));
    low = _mm512_min_epi32(low, at);
    high = _mm512_max_epi32(high, at);
  }
  std::int32_t lows[16], highs[16];
  _mm512_storeu_si512(lows, low);
  _mm512_storeu_si512(highs, high);
  ClosedBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::min({lows[axis], lows[axis + 4], lows[axis + 8], lows[axis + 12]});
    box.max[axis] = std::max({highs[axis], highs[axis + 4], highs[axis + 8], highs[axis + 12]});
  }
  return box;
}
#endif

std::size_t part_below(std::span<TreeItem> items, int axis, std::int32_t pivot) {
#if ARRIS_X86_KERNELS
  if (simd::widest_bytes() == 64 && items.size() >= 2 * kRead) return part_below_avx512(items, axis, pivot);
#endif
  return part(items, axis, [pivot](std::int32_t at) { return at < pivot; });
}

/// A coordinate that about `nth` of the items are below: a little more or fewer, so that what is left after parting by
/// it is most often the smaller part.
std::int32_t pivot_for(std::span<const TreeItem> items, std::size_t nth, int axis) {
  constexpr std::size_t kMostSamples = 31;
  constexpr std::size_t kItemsPerSample = 16;
  std::int32_t samples[kMostSamples];
  const std::size_t count = std::clamp<std::size_t>(items.size() / kItemsPerSample, 5, kMostSamples);
  for (std::size_t i = 0; i < count; ++i) samples[i] = items[items.size() * (2 * i + 1) / (2 * count)].at[axis];
  const std::size_t margin = (count + 1) / 16;
  std::size_t rank = nth * count / items.size();
  rank = 2 * nth < items.size() ? std::min(rank + margin, count - 1) : rank - std::min(rank, margin);
  std::nth_element(samples, samples + rank, samples + count);
  return samples[rank];
}

}  // namespace

ClosedBox box_of(std::span<const TreeItem> items) {
#if ARRIS_X86_KERNELS
  if (simd::widest_bytes() == 64 && items.size() >= kAtOnce) return box_of_avx512(items);
#endif
  ClosedBox box;
  for (int axis = 0; axis < 3; ++axis) box.min[axis] = box.max[axis] = items[0].at[axis];
  for (const TreeItem& item : items) {
    for (int axis = 0; axis < 3; ++axis) {
      box.min[axis] = std::min(box.min[axis], item.at[axis]);
      box.max[axis] = std::max(box.max[axis], item.at[axis]);
    }
  }
  return box;
}

void select_nth(std::span<TreeItem> items, std::size_t nth, int axis) {
  constexpr std::size_t kFew = 32;
  constexpr int kMostRounds = 64;  // Against orders that make every pivot a bad one.
  for (int round = 0; round < kMostRounds && items.size() > kFew; ++round) {
    const std::int32_t pivot = pivot_for(items, nth, axis);
    const std::size_t below = part_below(items, axis, pivot);
    if (nth < below) {
      items = items.first(below);
      continue;
    }
    const bool uneven = below < items.size() / 8;
    items = items.subspan(below);
    nth -= below;
    if (!uneven) continue;
    // Many may be equal to the pivot.
    const std::size_t equal = part(items, axis, [=](std::int32_t at) { return at == pivot; });
    if (nth < equal) return;
    items = items.subspan(equal);
    nth -= equal;
  }
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(nth), items.end(),
                   [axis](const TreeItem& a, const TreeItem& b) { return a.at[axis] < b.at[axis]; });
}

}  // namespace arris
