#include "features/segment/intensity_scale.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace arris {
namespace {

constexpr double kMostByte = 255.0;
constexpr std::uint64_t kPercent = 100;
constexpr std::uint32_t kSign = 0x80000000U;

/// Finite doubles beyond float32 become its greatest.
float to_float(double value) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -kMost, kMost));
}

/// Index of the bin that holds the value of a rank; `rank` becomes the rank within it.
std::uint32_t find_bin(const std::vector<std::uint64_t>& bins, std::uint64_t& rank) {
  std::uint32_t bin = 0;
  while (bin + 1 < bins.size() && rank >= bins[bin]) rank -= bins[bin++];
  return bin;
}

}  // namespace

std::uint8_t IntensityScale::byte_of(double intensity) const {
  if (!scaled) {
    const double rounded = std::floor(intensity + 0.5);
    return rounded > 0.0 ? static_cast<std::uint8_t>(std::min(rounded, kMostByte)) : 0;
  }
  const double value = to_float(intensity);  // As the percentiles saw it.
  if (!(value > low)) return 0;
  if (value >= high) return 255;
  return static_cast<std::uint8_t>(kMostByte * (value - low) / (high - low) + 0.5);
}

/// Keys have the order of the values. Of kAny; a word is its own upper half.
std::uint32_t IntensityPercentiles::key_of(double intensity) const {
  const auto bits = std::bit_cast<std::uint32_t>(to_float(intensity) + 0.0F);  // -0 becomes 0.
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

double IntensityPercentiles::value_of(std::uint32_t key) const {
  if (values_ == Values::kWords) return key >> 16;
  return std::bit_cast<float>((key & kSign) != 0 ? key & ~kSign : ~key);
}

void IntensityPercentiles::add_words(std::span<const double> intensities) {
  if (intensities.empty()) return;
  std::uint32_t least = static_cast<std::uint32_t>(kHalf), greatest = 0;
  for (const double value : intensities) {
    const auto word = static_cast<std::uint32_t>(value);
    ++upper_[word];
    least = std::min(least, word);
    greatest = std::max(greatest, word);
  }
  least_ = count_ == 0 ? least : std::min<double>(least_, least);
  greatest_ = std::max<double>(greatest_, greatest);
  count_ += intensities.size();
}

void IntensityPercentiles::add(std::span<const double> intensities) {
  if (values_ == Values::kWords) return add_words(intensities);
  for (const double value : intensities) {
    if (!std::isfinite(value)) continue;
    ++upper_[key_of(value) >> 16];
    least_ = count_ == 0 ? value : std::min(least_, value);
    greatest_ = count_ == 0 ? value : std::max(greatest_, value);
    fractions_ = fractions_ || value != std::floor(value);
    ++count_;
  }
}

bool IntensityPercentiles::is_8_bit() const {
  return count_ == 0 || (least_ >= 0.0 && greatest_ <= kMostByte && !(fractions_ && greatest_ <= 1.0));
}

bool IntensityPercentiles::needs_refining() {
  if (is_8_bit()) return false;
  const std::uint64_t skipped = (count_ - 1) / kPercent;
  ranks_[0].left = skipped;
  ranks_[1].left = count_ - 1 - skipped;
  for (Rank& rank : ranks_) {
    rank.upper = find_bin(upper_, rank.left);
    if (values_ == Values::kAny) rank.lower.assign(kHalf, 0);
  }
  return values_ == Values::kAny;
}

void IntensityPercentiles::refine(std::span<const double> intensities) {
  for (const double value : intensities) {
    if (!std::isfinite(value)) continue;
    const std::uint32_t key = key_of(value);
    for (Rank& rank : ranks_) {
      if (key >> 16 == rank.upper) ++rank.lower[key & (kHalf - 1)];
    }
  }
}

IntensityScale IntensityPercentiles::scale() const {
  IntensityScale scale;
  if (is_8_bit()) return scale;
  std::array<double, 2> found{};
  for (std::size_t i = 0; i < ranks_.size(); ++i) {
    std::uint64_t left = ranks_[i].left;
    const std::uint32_t lower = values_ == Values::kAny ? find_bin(ranks_[i].lower, left) : 0;
    found[i] = value_of(ranks_[i].upper << 16 | lower);
  }
  return {true, found[0], found[1]};
}

}  // namespace arris
