#pragma once
/// @file One record of a PLY element, of any format and with any properties: where it ends and what its numbers are.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "io/ply_header.h"

namespace arris::io {

/// Walks records of one element. Reused for many records without allocating. Not thread-safe.
class PlyRecordWalker {
 public:
  /// @param wanted  indices of scalar properties whose values are delivered, any order.
  PlyRecordWalker(PlyFormat format, const PlyElement& element, const std::vector<int>& wanted);

  enum class Result : std::uint8_t {
    kDone,  ///< The record lies in [begin(), end()) of the bytes given; value(i) is set.
    kMore,  ///< The bytes end within the record.
    kBad,   ///< problem() says what is wrong with it.
  };
  /// @param file_end  true if no bytes follow those given; only then does the last token of an ascii file end with
  /// them.
  Result walk(std::span<const std::byte> bytes, bool file_end);

  std::size_t begin() const { return begin_; }  ///< Behind the white space that precedes an ascii record.
  std::size_t end() const { return end_; }
  double value(std::size_t wanted) const { return values_[wanted]; }
  /// Ascii: a line ended in the white space before the record.
  bool follows_line_end() const { return follows_line_end_; }
  const std::string& problem() const { return problem_; }

 private:
  struct Step {
    PlyProperty property;
    int slot;  ///< Index into values_, or -1.
  };

  Result walk_ascii(std::string_view text, bool file_end);
  Result walk_binary(std::span<const std::byte> bytes);
  Result bad(std::string problem);
  bool next_token(std::string_view text, bool file_end, std::string_view& token);

  PlyFormat format_;
  std::vector<Step> steps_;
  std::vector<double> values_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  bool follows_line_end_ = false;
  std::string problem_;
};

/// A binary value as double; 64-bit integers are rounded.
double load_ply_value(PlyFormat format, ScalarType type, const std::byte* at);

}  // namespace arris::io
