#pragma once
/// @file Single attributes of points by name, from the records of a batch.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "io/point_source.h"

namespace arris::io {

/// Reads scalar attributes as double: LAS fields by the names of las_fields.h ("intensity", "red", ...) and extra bytes
/// of scalar type, PLY scalar properties (also under the name "scalar_<name>" that CloudCompare gives them, and those
/// of ply_field_names.h). Not thread-safe.
class AttributeReader {
 public:
  /// Opens `path` for its header only. Throws InputError / IoError.
  AttributeReader(const std::filesystem::path& path, const std::vector<std::string>& names);
  ~AttributeReader();
  AttributeReader(const AttributeReader&) = delete;
  AttributeReader& operator=(const AttributeReader&) = delete;

  /// True if the file has the attribute names[index].
  bool has(std::size_t index) const;
  /// Values of names[index] for a batch of this file that was read with records; `values` gets batch.count entries.
  /// Needs has().
  void read(const PointBatch& batch, std::size_t index, std::vector<double>& values);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace arris::io
