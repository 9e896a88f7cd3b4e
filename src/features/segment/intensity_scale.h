#pragma once
/// @file Intensities of any unit as 8 bits, as the thresholds of Yu et al. expect them.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace arris {

/// Intensities become 0 to 255. Immutable.
struct IntensityScale {
  bool scaled = false;  ///< False: values are rounded as they are.
  double low = 0.0;     ///< Becomes 0, as all below. Of `scaled` only.
  double high = 255.0;  ///< Becomes 255, as all above; >= low. If equal to low, greater values alone become 255.

  /// NaN becomes 0.
  std::uint8_t byte_of(double intensity) const;
};

/// Chooses the scale of a set of intensities: 8-bit values (none below 0, none above 255, not fractions of 1) stay as
/// they are; otherwise the 1st and the 99th percentile become 0 and 255. All equal: all become 0.
///
/// Percentiles are exact (of n values in ascending order, those that (n - 1) / 100 values precede and follow), for
/// numbers of 16 bits after one look at the values, for others (as float32) after two: the first counts the upper
/// halves of the 32-bit patterns, the second the lower halves within the two upper ones that matter. Counts have no
/// order, so the scale depends on the set alone. NaN and infinities do not count. 0.5 MB, then 1 MB. Not thread-safe.
class IntensityPercentiles {
 public:
  enum class Values : std::uint8_t { kWords /* whole numbers 0 to 65535 */, kAny };
  explicit IntensityPercentiles(Values values) : values_(values), upper_(kHalf) {}

  /// First look, any number of times.
  void add(std::span<const double> intensities);
  /// After the first look: true if a second one, of the same values, is needed before scale().
  bool needs_refining();
  void refine(std::span<const double> intensities);
  IntensityScale scale() const;

 private:
  static constexpr std::size_t kHalf = 65536;
  /// One of the percentiles on the way to it.
  struct Rank {
    std::uint64_t left = 0;  ///< Values of its upper half that precede it.
    std::uint32_t upper = 0;
    std::vector<std::uint64_t> lower;  ///< Counts of lower halves.
  };

  void add_words(std::span<const double> intensities);
  bool is_8_bit() const;
  std::uint32_t key_of(double intensity) const;
  double value_of(std::uint32_t key) const;

  Values values_;
  std::vector<std::uint64_t> upper_;
  std::uint64_t count_ = 0;
  double least_ = 0.0;
  double greatest_ = 0.0;
  bool fractions_ = false;
  std::array<Rank, 2> ranks_;  ///< Low, high.
};

}  // namespace arris
