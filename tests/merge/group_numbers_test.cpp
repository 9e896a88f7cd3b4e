// Numbers of groups against a walk through the ids.

#include "merge/group_numbers.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace arris::merge {
namespace {

struct Numbered {
  PointLabels labels;
  std::vector<std::uint32_t> groups;
  bool operator==(const Numbered&) const = default;
};

Numbered walked(std::span<const std::uint32_t> group_of, PointLabels labels) {
  Numbered out;
  std::vector<std::uint32_t> number(group_of.size() + 1, 0);
  for (std::uint32_t& label : labels) {
    const std::uint32_t group = label == 0 ? 0 : group_of[label - 1];
    if (group != 0 && number[group] == 0) {
      out.groups.push_back(group);
      number[group] = static_cast<std::uint32_t>(out.groups.size());
    }
    label = number[group];
  }
  out.labels = std::move(labels);
  return out;
}

TEST(GroupNumbers, AreThoseOfAWalkThroughTheIds) {
  for (const std::uint32_t used : {1U, 7U, 3000U}) {
    std::mt19937 engine(used);
    const auto random = [&](std::uint32_t end) { return static_cast<std::uint32_t>(engine() % end); };
    std::vector<std::uint32_t> group_of(used);
    for (std::uint32_t& group : group_of) group = random(used + 1);  // Some go; not every group is in use.
    PointLabels labels(200'000);
    for (std::size_t i = 0; i < labels.size(); ++i)  // Runs, as scans have them, and single ones.
      labels[i] = i > 0 && random(4) != 0 ? labels[i - 1] : random(used + 1);
    const Numbered expected = walked(group_of, labels);
    Numbered found{labels, {}};
    found.groups = number_groups(group_of, used, found.labels);
    EXPECT_TRUE(found == expected) << used;
  }
}

TEST(GroupNumbers, OfNothing_AreNone) {
  PointLabels none, unlabelled(5, 0);
  EXPECT_TRUE(number_groups({}, 0, none).empty());
  EXPECT_TRUE(number_groups({}, 0, unlabelled).empty());
  EXPECT_EQ(unlabelled, PointLabels(5, 0));
}

}  // namespace
}  // namespace arris::merge
