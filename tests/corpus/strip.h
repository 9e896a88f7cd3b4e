#pragma once
/// @file Takes out of an output what arris added to it, by the specifications of LAS and PLY and the names of our
/// columns alone. What is left should be the input. Independent of the library under test.

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace arris::test {

/// A column by the name it has in the file and its size in bytes.
struct AddedColumn {
  std::string name;
  std::size_t size_bytes = 0;
};

/// The columns of `arris extract`.
const std::vector<AddedColumn>& extract_columns();

/// Takes the columns, which are the last of each record, out of a LAS file: their bytes, their 192-byte descriptions
/// (with those of bytes that had none before, and the whole record where it holds nothing else), the mark "superseded"
/// on descriptions that ours replace; and moves the record length, the offset to the points and the starts of waveforms
/// and extended records back. Throws std::runtime_error if the columns are not described as the last ones.
std::string strip_las(const std::string& output, const std::vector<AddedColumn>& columns);

/// Names of header fields in which two LAS files of the same version differ: "legacy-count", "min-x", ...; "byte <n>"
/// for a header byte in none of those, "body" for anything behind the header, "size" for another size.
std::set<std::string> differing_fields(const std::string& a, const std::string& b);
/// The value of such a field as the table of verdicts writes it.
std::string field_value(const std::string& las, const std::string& field);

/// A PLY file in parts that can be compared. Ascii bodies are lists of tokens: white space has no meaning there.
struct PlyParts {
  /// Lines without their ends, also where these differ from that of the first line; blanks in "element" lines are
  /// single.
  std::vector<std::string> header;
  std::string line_end;
  bool ascii = false;
  std::vector<std::string> tokens;  ///< Of an ascii body ...
  std::string body;                 ///< ... or the bytes of a binary one.
};
PlyParts split_ply(const std::string& bytes);
/// Takes our properties, which are the last of each vertex, and our comment out.
PlyParts strip_ply(const std::string& output, const std::vector<AddedColumn>& columns);

}  // namespace arris::test
