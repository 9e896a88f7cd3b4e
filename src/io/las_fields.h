#pragma once
/// @file The fields of LAS point records by name: how conversions and statistics see them, in every point format.

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "io/scalar_type.h"

namespace arris::io {

/// Where a field lies in the records of a point format, and how. Without the coordinates and the waveform packet.
struct LasField {
  std::string_view name;  ///< "intensity", "classification", "scan_angle" (degrees), ...
  ScalarType type;        ///< Holds every value: what PLY files get.
  ScalarType stored;      ///< As it lies in the record.
  std::size_t offset;     ///< In the record.
  unsigned shift = 0;     ///< Of bit fields ...
  unsigned mask = 0;      ///< ... and their mask after the shift; 0: the whole of `stored`.
  double unit = 1.0;      ///< Value of one step.
};

/// In the order of the record. Valid point formats only.
const std::vector<LasField>& las_fields(std::uint8_t point_format);

double load_field(const LasField& field, const std::byte* record);
/// Stores the nearest value that the field can hold; the other bits of its byte stay. False if that is another value
/// than the one given (beyond rounding to the field's step).
bool store_field(const LasField& field, double value, std::byte* record);

}  // namespace arris::io
