#include "merge/group_numbers.h"

#include <algorithm>
#include <atomic>

#include "core/parallel.h"

namespace arris::merge {
namespace {

constexpr std::size_t kGrain = std::size_t{1} << 15;
constexpr std::uint32_t kNoId = 0xffffffffU;

void lower(std::uint32_t& least, std::uint32_t id) {
  const std::atomic_ref place(least);
  std::uint32_t before = place.load(std::memory_order_relaxed);
  while (id < before && !place.compare_exchange_weak(before, id, std::memory_order_relaxed)) {
  }
}

/// By group; kNoId where there is none.
std::vector<std::uint32_t> smallest_ids(std::span<const std::uint32_t> group_of, std::uint32_t groups,
                                        const PointLabels& labels) {
  std::vector<std::uint32_t> smallest(groups, kNoId);
  parallel_for_chunks(labels.size(), kGrain, [&](std::size_t first, std::size_t last) {
    std::uint32_t before = 0;
    for (std::size_t id = first; id < last; ++id) {
      if (labels[id] == before || labels[id] == 0) continue;
      before = labels[id];
      const std::uint32_t group = group_of[before - 1];
      if (group != 0) lower(smallest[group - 1], static_cast<std::uint32_t>(id));
    }
  });
  return smallest;
}

}  // namespace

std::vector<std::uint32_t> number_groups(std::span<const std::uint32_t> group_of, std::uint32_t groups,
                                         PointLabels& labels) {
  const std::vector<std::uint32_t> smallest = smallest_ids(group_of, groups, labels);
  std::vector<std::uint32_t> numbered;
  for (std::uint32_t group = 1; group <= groups; ++group)
    if (smallest[group - 1] != kNoId) numbered.push_back(group);
  std::ranges::sort(numbered, {}, [&](std::uint32_t group) { return smallest[group - 1]; });
  std::vector<std::uint32_t> number_of_group(groups + std::size_t{1}, 0);
  for (std::uint32_t i = 0; i < numbered.size(); ++i) number_of_group[numbered[i]] = i + 1;
  parallel_for_chunks(labels.size(), kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t id = first; id < last; ++id)
      if (labels[id] != 0) labels[id] = number_of_group[group_of[labels[id] - 1]];
  });
  return numbered;
}

}  // namespace arris::merge
