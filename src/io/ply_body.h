#pragma once
/// @file Where the elements of a PLY file lie behind its header.

#include <cstdint>
#include <string>

#include "io/input_file.h"
#include "io/ply_header.h"
#include "io/ply_record.h"

namespace arris::io {

/// Makes the walker read the record at the window's position, extending the window as needed; the caller consumes
/// walker.end() bytes. Throws InputError that names the element, its index and the byte, if it is damaged or the file
/// ends.
void read_ply_record(const InputFile& file, const PlyHeader& header, std::size_t element, std::uint64_t index,
                     FileWindow& window, PlyRecordWalker& walker);

/// Offset of the first byte behind `element`, whose first byte (or preceding white space) is at `begin`. Binary
/// elements without lists are found by arithmetic, others by reading them. Throws InputError if the file ends before.
std::uint64_t skip_ply_element(const InputFile& file, const PlyHeader& header, std::size_t element,
                               std::uint64_t begin);

/// Records before the first one that is damaged or cut off, and the offset behind them.
struct WholeRecords {
  std::uint64_t count = 0;
  std::uint64_t end = 0;
};
WholeRecords count_whole_records(const InputFile& file, const PlyHeader& header, std::size_t element,
                                 std::uint64_t begin);

/// Offset of the first byte of `element`.
std::uint64_t find_ply_element(const InputFile& file, const PlyHeader& header, std::size_t element);

}  // namespace arris::io
