#pragma once
/// @file Variable-length records that a LAS output takes over although its points have a new layout.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/input_file.h"
#include "io/las_file.h"
#include "io/output_file.h"
#include "io/point_source.h"

namespace arris::io {

/// Those of the first LAS input, except what describes extra bytes, waveforms or compression; without a LAS input, the
/// coordinate reference system that a comment of the first PLY input describes in WKT. Not thread-safe.
class CarriedRecords {
 public:
  explicit CarriedRecords(const std::vector<SourceInfo>& inputs);
  bool has_las() const { return las_file_ != nullptr; }
  /// Of the input the records come from.
  std::string name() const;
  /// Append to the output and return their number.
  std::uint32_t write_vlrs(OutputFile& output) const;
  std::uint32_t write_evlrs(OutputFile& output) const;
  /// Sets the bits of the global encoding for WKT and for the kind of GPS time.
  /// @param extended  the output has one of the point formats 6 to 10, which want WKT unless only GeoTIFF keys are
  /// there.
  void set_encoding(bool extended, std::span<std::byte> header) const;

 private:
  std::filesystem::path path_;
  std::unique_ptr<InputFile> las_file_;
  LasFile las_;
  std::string ply_wkt_;
};

}  // namespace arris::io
