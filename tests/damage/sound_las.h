#pragma once
/// @file Sound LAS files to damage, and the places of their fields by the specification.

#include <cstdint>
#include <string>

#include "io/las_builder.h"

namespace arris::test {

/// Offsets of header fields.
namespace las_at {
inline constexpr std::size_t kGlobalEncoding = 6, kMajor = 24, kMinor = 25, kHeaderSize = 94, kOffsetToPoints = 96,
                             kVlrCount = 100, kPointFormat = 104, kRecordLength = 105, kLegacyCount = 107,
                             kLegacyByReturn = 111, kScale = 131, kOffset = 155, kBounds = 179, kWaveformStart = 227,
                             kEvlrStart = 235, kEvlrCount = 243, kPointCount = 247, kByReturn = 255;
}  // namespace las_at

/// Points of every sound file, unless stated otherwise.
inline constexpr std::uint64_t kSoundPoints = 10;

/// A plan whose file has nothing to report: points on a line, each the only return of its pulse.
LasPlan sound_plan(int minor, int format, std::uint64_t points = kSoundPoints, std::size_t extra_bytes = 0);

/// The plan's file, with bounds and counts by return that are those of its points.
std::string sound_las(const LasPlan& plan);
inline std::string sound_las(int minor, int format, std::uint64_t points = kSoundPoints, std::size_t extra_bytes = 0) {
  return sound_las(sound_plan(minor, format, points, extra_bytes));
}

/// The bytes with one value replaced.
template <typename T>
std::string with(std::string bytes, std::size_t at, T value) {
  put<T>(bytes, at, value);
  return bytes;
}

}  // namespace arris::test
