#pragma once
/// @file The attributes of an output made from inputs with different ones.

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "io/record_reader.h"

namespace arris::io {

/// All columns of all inputs, matched by their common names, in the order in which they first appear. A column's type
/// holds the values of every input. Colours of different depth are brought to the deeper one (255 -> 65535, 1.0 ->
/// 65535). Immutable; safe to use from several threads.
class ColumnUnion {
 public:
  /// @param colour_type  what all colours become, whatever the inputs have.
  explicit ColumnUnion(const std::vector<std::unique_ptr<RecordReader>>& inputs,
                       std::optional<ScalarType> colour_type = std::nullopt);

  const std::vector<RecordColumn>& columns() const { return columns_; }
  /// Index of a column by its common name, or -1.
  int find(std::string_view name) const;
  /// True if that input has the column.
  bool has(std::size_t input, std::size_t column) const { return routes_[input][column].from >= 0; }
  /// Brings one record's values to the order of columns(). What the input lacks is NaN in floating-point columns, else
  /// 0.
  void map(std::size_t input, std::span<const double> values, std::span<double> out) const;

 private:
  struct Route {
    int from = -1;        ///< Column of the input.
    double factor = 1.0;  ///< Of colours.
  };
  std::vector<RecordColumn> columns_;
  std::unordered_map<std::string, int> index_;  ///< Of columns_, by common name.
  std::vector<std::vector<Route>> routes_;      ///< Per input and column.
};

/// Largest value of a colour stored in that type: 255, 65535, or 1 for floating point.
double most_colour(ScalarType type);

}  // namespace arris::io
