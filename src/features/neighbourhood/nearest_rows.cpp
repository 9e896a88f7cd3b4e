#include "features/neighbourhood/nearest_rows.h"

#include <algorithm>

#include "features/neighbourhood/distance_ranks.h"
#include "features/numerics/columns_of_four.h"

namespace arris {
namespace {

/// Exact, as long as kExactSquares<float> is kept.
float squared(const PackedCandidate& row, const NearestQuery<float>& query) {
  const float dx = row.x - query.x, dy = row.y - query.y, dz = row.z - query.z;
  return dx * dx + dy * dy + dz * dz;
}

/// Puts runs of equal distances that begin before `wanted` into the order of ids.
void order_ties(const PointTree& tree, const NearestQuery<float>& query, std::size_t n, std::size_t wanted,
                PackedCandidate* rows) {
  for (std::size_t begin = 0; begin < wanted;) {
    std::size_t end = begin + 1;
    while (end < n && squared(rows[end], query) == squared(rows[begin], query)) ++end;
    if (end - begin > 1) {
      std::sort(rows + begin, rows + end, [&tree](const PackedCandidate& a, const PackedCandidate& b) {
        return tree.id(a.slot) < tree.id(b.slot);
      });
    }
    begin = end;
  }
}

struct PartRows {
  template <int Bytes>
  static ARRIS_ALWAYS_INLINE void run(const PackedCandidate& query, const PackedCandidate* rows, Neighbours& found) {
    using V = typename simd::Wide<Bytes>::Float;
    constexpr std::size_t kLanes = Bytes / sizeof(float);
    for (std::size_t begin = 0; begin < found.count; begin += kLanes) {
      simd::ColumnsOfFour<V> columns([&](std::size_t i) __attribute__((always_inline)) { return rows + begin + i; });
      columns.a -= query.x;
      columns.b -= query.y;
      columns.c -= query.z;
      simd::store_doubles(found.dx.data() + begin, columns.a);
      simd::store_doubles(found.dy.data() + begin, columns.b);
      simd::store_doubles(found.dz.data() + begin, columns.c);
      const V d2 = columns.a * columns.a + columns.b * columns.b + columns.c * columns.c;
      simd::store_doubles(found.d2.data() + begin, d2);
      simd::store(found.slot.data() + begin, columns.d);
    }
  }
};

}  // namespace

std::size_t rank_rows(const PointTree& tree, const CandidateSet<float>& candidates, const NearestQuery<float>& query,
                      std::size_t n, NearestScratch<float>& scratch, PackedCandidate* rows) {
  const bool ties = rank_distances(scratch.d2.data(), n, scratch.rank.data());
  for (std::size_t i = 0; i < n; ++i)
    rows[static_cast<std::size_t>(scratch.rank[i])] = candidates.packed[scratch.candidate[i]];
  const std::size_t wanted = std::min(n, query.k + 1);
  if (ties) order_ties(tree, query, n, wanted, rows);
  return wanted - 1;
}

void part_rows(PackedCandidate* rows, Neighbours& found) {
  std::fill(rows + 1 + found.count, rows + 1 + simd::padded(found.count), rows[0]);
  simd::dispatch<PartRows>(rows[0], rows + 1, found);
  found.last_d2 = found.count > 0 ? static_cast<std::uint64_t>(found.d2[found.count - 1]) : 0;
}

}  // namespace arris
