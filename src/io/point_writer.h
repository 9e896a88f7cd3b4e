#pragma once
/// @file Writers of points: copies of original records with our columns appended, and clouds made from nothing (synth).

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/columns.h"
#include "io/point_source.h"

namespace arris::io {

/// Range of finite world coordinates; min > max where there are none.
struct WorldExtent {
  std::array<double, 3> min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::infinity()};
  std::array<double, 3> max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                            -std::numeric_limits<double>::infinity()};
};

/// A file that appears under its final name only when commit() has succeeded: it is written as "<name>.partial-<pid>"
/// next to it, flushed, synced and renamed. Destroyed without commit, it removes the partial file. Refuses an existing
/// final file unless overwrite is set (checked at construction and again at commit).
struct OutputOptions {
  bool overwrite = false;
  /// The caller will append every point of the inputs: PLY elements that refer to vertices by number stay valid then.
  bool every_point = false;
  /// Inputs with different coordinate reference systems go into one output, which names the first one.
  bool mixed_crs = false;
  /// Extent of all points of the inputs, if the caller knows it: saves PLY -> LAS a pass over them to choose scale and
  /// offset.
  std::optional<WorldExtent> extent{};
};

/// Writes kept points of inputs. Call append() in ascending order of ids, then commit(). Not thread-safe.
class KeptPointWriter {
 public:
  virtual ~KeptPointWriter() = default;
  /// Writes the points of `batch` (which came from source `source_index` of the inputs, with records) whose positions
  /// are in `kept` (ascending), with `rows` holding one packed row of our columns per kept point.
  virtual void append(std::size_t source_index, const PointBatch& batch, std::span<const std::uint32_t> kept,
                      std::span<const std::byte> rows) = 0;
  /// Completes headers and makes the file appear. May add warnings. Throws IoError.
  virtual void commit() = 0;
  /// What this output cannot carry or had to change, one printable line each.
  virtual const std::vector<std::string>& warnings() const = 0;
};

/// The extension of `path` picks the format (.las, .ply; otherwise ConfigError). Inputs of that format with one layout:
/// original bytes of every kept record are copied bit for bit, VLRs/EVLRs, scale, offset, property order, endianness
/// and comments kept, our columns appended (LAS: extra bytes with their VLR, PLY: properties at the end of the vertex
/// element). Inputs of the other format, of both, or of different layouts: conversion field by field (docs/formats.md)
/// to the layout that holds all their attributes. Different coordinate reference systems are a ConfigError unless
/// options.mixed_crs.
std::unique_ptr<KeptPointWriter> create_kept_point_writer(const std::filesystem::path& path, const InputSet& inputs,
                                                          const std::vector<ColumnSpec>& columns,
                                                          const OutputOptions& options);

/// A cloud made from nothing.
struct FreshCloud {
  double scale = 0.001;  ///< LAS scale of all axes; PLY stores doubles of the same rounded coordinates.
  std::array<double, 3> offset{0.0, 0.0, 0.0};  ///< LAS offset.
  bool colour = false;
  std::string generator = "arris";
  std::optional<ColumnSpec> label{};  ///< Of type kUint32: the column that FreshPoint::label is written to.
};

struct FreshPoint {
  double x = 0.0, y = 0.0, z = 0.0;
  std::uint16_t intensity = 0;
  std::uint8_t classification = 0;
  std::uint16_t point_source_id = 0;
  std::uint16_t red = 0, green = 0, blue = 0;
  std::uint32_t label = 0;  ///< Written if FreshCloud::label names a column.
};

/// Streams a new cloud of unknown length in bounded memory. LAS 1.4 point format 6 (7 with colour); PLY binary
/// little-endian.
class FreshCloudWriter {
 public:
  virtual ~FreshCloudWriter() = default;
  virtual void append(std::span<const FreshPoint> points) = 0;
  virtual void commit() = 0;
};
std::unique_ptr<FreshCloudWriter> create_fresh_cloud_writer(const std::filesystem::path& path, const FreshCloud& cloud,
                                                            const OutputOptions& options);

}  // namespace arris::io
