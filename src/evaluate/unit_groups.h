#pragma once
/// @file Items whose tolerances differ, grouped so that searches within a tolerance stay local. Private to evaluate.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace arris::evaluate {

/// Items whose units share a power of two.
struct UnitGroup {
  std::vector<std::uint32_t> items;  ///< Ascending.
  double longest = 0.0;              ///< Largest unit, data units.
};

/// @param units  > 0, one per item. Groups by ascending unit.
inline std::vector<UnitGroup> group_by_unit(std::span<const double> units) {
  std::map<int, UnitGroup> groups;
  for (std::size_t i = 0; i < units.size(); ++i) {
    UnitGroup& group = groups[std::ilogb(units[i])];
    group.items.push_back(static_cast<std::uint32_t>(i));
    group.longest = std::max(group.longest, units[i]);
  }
  std::vector<UnitGroup> result;
  for (auto& [exponent, group] : groups) result.push_back(std::move(group));
  return result;
}

}  // namespace arris::evaluate
