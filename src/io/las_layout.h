#pragma once
/// @file Fixed facts of the LAS format: sizes and places of fields (ASPRS LAS 1.0 to 1.4 R15, and the header of 1.5).

#include <array>
#include <cstddef>
#include <cstdint>

namespace arris::io {

inline constexpr int kLasNewestMinor = 5;
inline constexpr std::size_t kLasPointFormats = 11;
inline constexpr std::size_t kVlrHeaderBytes = 54;
inline constexpr std::size_t kEvlrHeaderBytes = 60;
inline constexpr std::size_t kLasMaxRecordBytes = 65535;

/// Size of the header that each minor version defines; files may have longer ones.
inline constexpr std::array<std::size_t, 6> kLasHeaderBytes{227, 227, 227, 235, 375, 393};

/// Offsets of header fields. The last ones exist from the given version on.
enum LasHeaderField : std::size_t {
  kFileSourceId = 4,
  kGlobalEncoding = 6,
  kGuid = 8,
  kVersionMajor = 24,
  kVersionMinor = 25,
  kSystemIdentifier = 26,
  kGeneratingSoftware = 58,
  kCreationDay = 90,
  kCreationYear = 92,
  kHeaderSize = 94,
  kOffsetToPoints = 96,
  kVlrCount = 100,
  kPointFormat = 104,
  kRecordLength = 105,
  kLegacyCount = 107,
  kLegacyByReturn = 111,
  kScale = 131,
  kOffset = 155,
  kBounds = 179,          ///< max x, min x, max y, min y, max z, min z
  kWaveformStart = 227,   ///< 1.3
  kEvlrStart = 235,       ///< 1.4
  kEvlrCount = 243,       ///< 1.4
  kPointCount = 247,      ///< 1.4
  kPointsByReturn = 255,  ///< 1.4
};

/// Bits of the global encoding.
inline constexpr std::uint16_t kEncodingInternalWaveforms = 2;
inline constexpr std::uint16_t kEncodingExternalWaveforms = 4;
inline constexpr std::uint16_t kEncodingWkt = 16;

/// What a point format holds and where. An offset of 0 means that the format lacks the field.
struct LasPointLayout {
  std::size_t size_bytes;
  std::size_t gps_time;
  std::size_t colour;
  std::size_t infrared;
  std::size_t waveform;
};

inline constexpr std::array<LasPointLayout, kLasPointFormats> kLasPointLayouts{{
    {20, 0, 0, 0, 0},
    {28, 20, 0, 0, 0},
    {26, 0, 20, 0, 0},
    {34, 20, 28, 0, 0},
    {57, 20, 0, 0, 28},
    {63, 20, 28, 0, 34},
    {30, 22, 0, 0, 0},
    {36, 22, 30, 0, 0},
    {38, 22, 30, 36, 0},
    {59, 22, 0, 0, 30},
    {67, 22, 30, 36, 38},
}};

/// Point formats 6 to 10 arrange the bytes behind the intensity differently.
inline constexpr bool is_extended_format(std::uint8_t point_format) {
  return point_format >= 6;
}

/// Degrees per unit of the scan angle of point formats 6 to 10.
inline constexpr double kScanAngleStepDeg = 0.006;

/// World coordinate of a stored integer, as the specification defines it.
inline double las_world(double scale, double offset, std::int32_t stored) {
  return static_cast<double>(stored) * scale + offset;
}

}  // namespace arris::io
