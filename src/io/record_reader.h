#pragma once
/// @file The attributes of a point record as numbers, the same way for every format: for conversions and statistics.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/input_file.h"
#include "io/point_source.h"
#include "io/scalar_type.h"

namespace arris::io {

struct RecordColumn {
  std::string name;  ///< x, y, z, the names of las_fields.h for what is known by other names too, else the file's own.
  std::string name_in_file;
  ScalarType type = ScalarType::kFloat64;  ///< Holds every value.
};

/// Reads the scalar attributes of records of one file. Not thread-safe.
class RecordReader {
 public:
  virtual ~RecordReader() = default;
  const std::vector<RecordColumn>& columns() const { return columns_; }
  /// Index of a column by either name (the common one first), or -1.
  int find(std::string_view name) const;
  /// What the columns do not hold: one printable line each.
  const std::vector<std::string>& losses() const { return losses_; }
  /// @param record  a whole record of that file. @param values  columns().size() entries.
  virtual void read(std::span<const std::byte> record, std::span<double> values) = 0;

 protected:
  std::vector<RecordColumn> columns_;
  std::vector<std::string> losses_;
};

/// For LAS: x, y, z in world units, las_fields(), and the described extra bytes: arrays as <name>_0, <name>_1, ...;
/// with a scale or offset as the doubles that they mean. For PLY: the scalar vertex properties.
std::unique_ptr<RecordReader> make_record_reader(const InputFile& file, const SourceInfo& info);

}  // namespace arris::io
