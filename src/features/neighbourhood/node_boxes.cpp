#include "features/neighbourhood/node_boxes.h"

#include <algorithm>
#include <bit>

#include "features/numerics/simd_compact.h"

namespace arris {
namespace {

constexpr int kLevels = 3;  ///< That one step goes down.
constexpr std::size_t kAtOnce = std::size_t{1} << kLevels;
/// Of nodes that are still to be opened: in each step less than kAtOnce more, of trees of 2^32 leaves.
constexpr std::size_t kMostOpen = kAtOnce * (32 / kLevels + 2);

struct Columns {
  const float* min[3];
  const float* max[3];
};

struct Query {
  OuterBox box;
  float limit;  ///< Greatest squared distance.
};

#if ARRIS_X86_KERNELS
/// Finds out for eight nodes which are near: squared_distance() of all at once.
struct EightAtOnce {
  ARRIS_TARGET_V3 static unsigned near(const Columns& boxes, std::size_t first, const Query& query) {
    __m256 sum = _mm256_setzero_ps();
    for (int axis = 0; axis < 3; ++axis) {
      const __m256 below = _mm256_sub_ps(_mm256_set1_ps(query.box.min[axis]), _mm256_loadu_ps(boxes.max[axis] + first));
      const __m256 above = _mm256_sub_ps(_mm256_loadu_ps(boxes.min[axis] + first), _mm256_set1_ps(query.box.max[axis]));
      const __m256 gap = _mm256_max_ps(_mm256_max_ps(below, above), _mm256_setzero_ps());
      sum = _mm256_add_ps(sum, _mm256_mul_ps(gap, gap));
    }
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(sum, _mm256_set1_ps(query.limit), _CMP_LE_OQ)));
  }
};
#endif

struct OneByOne {
  static unsigned near(const Columns& boxes, std::size_t first, const Query& query) {
    unsigned mask = 0;
    for (std::size_t i = 0; i < kAtOnce; ++i) {
      OuterBox box;
      for (int axis = 0; axis < 3; ++axis) {
        box.min[axis] = boxes.min[axis][first + i];
        box.max[axis] = boxes.max[axis][first + i];
      }
      mask |= static_cast<unsigned>(squared_distance(query.box, box) <= query.limit) << i;
    }
    return mask;
  }
};

template <class Test>
void find_leaves(const Columns& boxes, int depth, const Query& query, std::vector<std::uint32_t>& leaves) {
  const std::size_t first_leaf = std::size_t{1} << depth;
  std::size_t open[kMostOpen];
  std::size_t count = 0;
  // The first step goes down so far that all others go down three levels.
  std::size_t first = std::size_t{1} << depth % kLevels;
  unsigned near = Test::near(boxes, first, query) & ((1U << first) - 1U);
  for (;;) {
    if (first >= first_leaf) {
      for (; near != 0; near &= near - 1) {
        leaves.push_back(static_cast<std::uint32_t>(first - first_leaf) +
                         static_cast<std::uint32_t>(std::countr_zero(near)));
      }
    } else {
      while (near != 0) {  // The last one first: it is opened last.
        const unsigned last = static_cast<unsigned>(std::bit_width(near)) - 1U;
        open[count++] = first + last;
        near ^= 1U << last;
      }
    }
    if (count == 0) return;
    first = open[--count] << kLevels;
    near = Test::near(boxes, first, query);
  }
}

}  // namespace

NodeBoxes::NodeBoxes(int depth)
    : depth_(depth),
      nodes_(std::max(std::size_t{2} << depth, 2 * kAtOnce)),  // Eight are read where there are fewer.
      sides_(6 * nodes_, 0.0F) {}

void NodeBoxes::set(std::size_t node, const OuterBox& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sides_[axis * nodes_ + node] = box.min[axis];
    sides_[(axis + 3) * nodes_ + node] = box.max[axis];
  }
}

OuterBox NodeBoxes::operator[](std::size_t node) const {
  OuterBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = least(axis)[node];
    box.max[axis] = most(axis)[node];
  }
  return box;
}

void NodeBoxes::leaves_near(const OuterBox& box, double reach, std::vector<std::uint32_t>& leaves) const {
  const Columns columns{{least(0), least(1), least(2)}, {most(0), most(1), most(2)}};
  const Query query{box, static_cast<float>(reach * reach * (1.0 + kBoxDistanceError))};
#if ARRIS_X86_KERNELS
  if (simd::widest_bytes() >= 32) return find_leaves<EightAtOnce>(columns, depth_, query, leaves);
#endif
  find_leaves<OneByOne>(columns, depth_, query, leaves);
}

}  // namespace arris
