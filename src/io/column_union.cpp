#include "io/column_union.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace arris::io {
namespace {

bool is_colour(std::string_view name) {
  constexpr std::array<std::string_view, 4> kColours{"red", "green", "blue", "nir"};
  return std::find(kColours.begin(), kColours.end(), name) != kColours.end();
}

ScalarType joined_type(const RecordColumn& a, const RecordColumn& b) {
  if (a.type == b.type) return a.type;
  return is_colour(a.name) ? ScalarType::kUint16 : common_type(a.type, b.type);
}

}  // namespace

double most_colour(ScalarType type) {
  if (!is_integer(type)) return 1.0;
  return size_bytes(type) == 1 ? 255.0 : 65535.0;
}

ColumnUnion::ColumnUnion(const std::vector<std::unique_ptr<RecordReader>>& inputs,
                         std::optional<ScalarType> colour_type) {
  for (const auto& input : inputs) {
    for (const RecordColumn& column : input->columns()) {
      const int at = find(column.name);
      if (at < 0) {
        index_.emplace(column.name, static_cast<int>(columns_.size()));
        columns_.push_back(column);
        continue;
      }
      RecordColumn& known = columns_[static_cast<std::size_t>(at)];
      known.type = joined_type(known, column);
      if (known.name_in_file != column.name_in_file) known.name_in_file = known.name;
    }
  }
  for (RecordColumn& column : columns_) {
    if (colour_type && is_colour(column.name)) column.type = *colour_type;
  }
  for (const auto& input : inputs) {
    std::vector<Route>& routes = routes_.emplace_back(columns_.size());
    for (std::size_t i = 0; i < input->columns().size(); ++i) {
      const RecordColumn& column = input->columns()[i];
      const auto at = static_cast<std::size_t>(find(column.name));
      routes[at].from = static_cast<int>(i);
      if (is_colour(column.name)) routes[at].factor = most_colour(columns_[at].type) / most_colour(column.type);
    }
  }
}

int ColumnUnion::find(std::string_view name) const {
  const auto found = index_.find(std::string(name));
  return found == index_.end() ? -1 : found->second;
}

void ColumnUnion::map(std::size_t input, std::span<const double> values, std::span<double> out) const {
  const std::vector<Route>& routes = routes_[input];
  for (std::size_t i = 0; i < routes.size(); ++i) {
    if (routes[i].from >= 0) {
      out[i] = values[static_cast<std::size_t>(routes[i].from)] * routes[i].factor;
    } else {
      out[i] = is_integer(columns_[i].type) ? 0.0 : std::numeric_limits<double>::quiet_NaN();
    }
  }
}

}  // namespace arris::io
