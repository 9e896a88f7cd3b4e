#pragma once
/// @file The range of one world coordinate, robust against a few absurd outliers.

#include <cstdint>
#include <map>
#include <optional>

namespace arris::tiling {

/// Coordinates beyond this take no part in anything: no lattice of a sensible step reaches them.
constexpr double kLargestCoordinate = 1e12;
/// Share of the points that a window must hold for the rest to count as outliers.
constexpr double kWindowShare = 0.999;

/// Minimum, maximum and a coarse sparse histogram (at most 4096 cells; wider cells when more are needed). Everything it
/// returns depends on the set of coordinates only, not on their order. Not thread-safe.
class AxisRange {
 public:
  /// @param cell  width of a histogram cell to start from, > 0.
  explicit AxisRange(double cell) : cell_(cell) {}

  /// Ignores coordinates that are not finite or larger than kLargestCoordinate.
  void add(double coordinate);

  struct Window {
    double min = 0.0;
    double max = 0.0;
  };
  /// The whole range if it is at most `length` long; otherwise the window of at most `length`, in whole histogram
  /// cells, with the most points (the leftmost such) if it holds the share kWindowShare of them; otherwise nothing. No
  /// points: [0, 0].
  std::optional<Window> window(double length) const;

 private:
  void count_cell(std::int64_t cell);

  double cell_;
  double min_ = 0.0;
  double max_ = 0.0;
  std::uint64_t points_ = 0;
  std::map<std::int64_t, std::uint64_t> cells_;
  std::int64_t last_cell_ = 0;
  std::uint64_t* last_count_ = nullptr;
};

}  // namespace arris::tiling
